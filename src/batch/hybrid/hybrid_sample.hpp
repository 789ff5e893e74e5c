// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/thresholds.hpp"
#include "batch/hybrid/hybrid_tree.hpp"
#include "batch/leaf/ranked_lows.hpp"

/// Random choices of the paper's tree at a node: the same each time, on every machine.
namespace boxstream::detail {

/// Even, and without a period that regular input could follow.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}

  std::size_t below(std::size_t size) {
    state_ += 0x9e3779b97f4a7c15u;
    std::uint64_t z = (state_ ^ (state_ >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<std::size_t>(((z ^ (z >> 31)) >> 32) * size >> 32);  // a set has less than 2^32 boxes
  }

 private:
  std::uint64_t state_;
};

/// ApproxMedian (section 3, figure 4): of 3^height points, medians of three, and medians of these. It is never the
/// lowest, for the three at the bottom are different points: so both halves of a node get some. Points rank by low end
/// and, among equals, by place.
class ApproxMedian {
 public:
  ApproxMedian(const HybridTree::Node& node, int axis) : node_(node), axis_(axis), chance_(node.points() + 1) {}

  /// Of at least three points.
  std::uint64_t operator()() { return of(height(node_.points())); }

 private:
  /// Level(n) of the paper: of every size the same share is looked at, 729 of 100 000.
  static int height(std::size_t points) {
    int height = 1;
    for (std::size_t size = 100'000 / 243 + 1; size < points; size *= 3) ++height;
    return height;
  }

  std::uint64_t of(int height) {
    std::uint64_t value[3];
    if (height == 1) {
      const std::size_t n = node_.points(), i = chance_.below(n), j = (i + 1 + chance_.below(n - 1)) % n;
      const std::size_t first = std::min(i, j), second = std::max(i, j);
      std::size_t k = chance_.below(n - 2);
      k += k >= first ? 1 : 0;
      k += k >= second ? 1 : 0;
      value[0] = point(i);
      value[1] = point(j);
      value[2] = point(k);
    } else {
      for (std::uint64_t& v : value) v = of(height - 1);
    }
    return std::max(std::min(value[0], value[1]), std::min(std::max(value[0], value[1]), value[2]));
  }

  std::uint64_t point(std::size_t rank) const {
    const HybridTree::Set &a = node_.set[0], &b = node_.set[1];
    return ranked((rank < a.points ? a.records[rank] : b.records[rank - a.points]).lo[axis_], rank);
  }

  const HybridTree::Node& node_;
  int axis_;
  Chance chance_;
};

/// How many of the pairs of `a` and `b` overlap on an axis, told by some of them.
class OverlapSample {
 public:
  OverlapSample(Span<const Record> a, Span<const Record> b, int axis)
      : size_(a.size() + b.size() < thresholds.large_node ? thresholds.overlap_sample
                                                          : thresholds.large_overlap_sample) {
    Chance chance(a.size() + b.size());
    draw(a, axis, chance, lo_[0], hi_[0]);
    draw(b, axis, chance, lo_[1], hi_[1]);
  }

  std::uint64_t pairs() const { return std::uint64_t{size_} * size_; }
  std::uint64_t overlapping() const {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::int32_t lo = lo_[0][i], hi = hi_[0][i];
      std::uint32_t count = 0;
      for (std::size_t j = 0; j < size_; ++j)
        count += static_cast<std::uint32_t>(lo <= hi_[1][j]) & static_cast<std::uint32_t>(lo_[1][j] <= hi);
      sum += count;
    }
    return sum;
  }

 private:
  static constexpr std::size_t most = 256;
  static_assert(thresholds.overlap_sample <= most && thresholds.large_overlap_sample <= most);

  void draw(Span<const Record> records, int axis, Chance& chance, std::int32_t* lo, std::int32_t* hi) const {
    for (std::size_t i = 0; i < size_; ++i) {
      const Record& r = records[chance.below(records.size())];
      lo[i] = r.lo[axis];
      hi[i] = r.hi[axis];
    }
  }

  std::size_t size_;
  std::int32_t lo_[2][most], hi_[2][most];
};

}  // namespace boxstream::detail
