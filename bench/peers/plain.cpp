// SPDX-License-Identifier: MIT
// Searches as one writes them first, with and without columns.
#include "peers/plain.hpp"

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "peers/sorted_sweep.hpp"

namespace boxstream::bench {

namespace {

/// Boxes as one array per side, in whatever order they were added.
struct BoxArrays {
  std::vector<float> low[3], high[3];
  std::vector<std::uint32_t> id;

  void resize(std::size_t n) {
    for (int d = 0; d < 3; ++d) {
      low[d].resize(n);
      high[d].resize(n);
    }
    id.resize(n);
  }

  void set(std::size_t i, const Aabb& box, std::uint32_t index) {
    for (int d = 0; d < 3; ++d) {
      low[d][i] = box.min[d];
      high[d][i] = box.max[d];
    }
    id[i] = index;
  }

  /// Appends the pairs of box i with each of [first, last). The comparisons have no branch, so compilers vectorise
  /// them.
  void match(std::size_t i, std::size_t first, std::size_t last, std::vector<Pair>& pairs) const {
    constexpr std::size_t block = 64;
    const float *x0 = low[0].data(), *x1 = high[0].data(), *y0 = low[1].data(), *y1 = high[1].data(),
                *z0 = low[2].data(), *z1 = high[2].data();
    const float ax0 = x0[i], ax1 = x1[i], ay0 = y0[i], ay1 = y1[i], az0 = z0[i], az1 = z1[i];
    std::int32_t hits[block];
    for (std::size_t start = first; start < last; start += block) {
      const std::size_t count = last - start < block ? last - start : block;
      std::int32_t any = 0;
      for (std::size_t k = 0; k < count; ++k) {
        const std::size_t j = start + k;
        hits[k] = (x0[j] <= ax1) & (ax0 <= x1[j]) & (y0[j] <= ay1) & (ay0 <= y1[j]) & (z0[j] <= az1) & (az0 <= z1[j]);
        any |= hits[k];
      }
      if (!any) continue;
      for (std::size_t k = 0; k < count; ++k)
        if (hits[k]) {
          const std::uint32_t a = id[i], b = id[start + k];
          pairs.push_back(a < b ? Pair{a, b} : Pair{b, a});
        }
    }
  }
};

class BareLoop final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    const auto n = static_cast<std::uint32_t>(boxes.size());
    for (std::uint32_t i = 0; i < n; ++i)
      for (std::uint32_t j = i + 1; j < n; ++j)
        if (overlaps(boxes[i], boxes[j])) pairs.push_back({i, j});
  }
};

class SortedSweep final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    sorted_sweep<float>(boxes, order_, pairs);
  }

 private:
  std::vector<std::uint32_t> order_;
};

/// All against all, in columns.
class BruteForce final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    arrays_.resize(boxes.size());
    for (std::size_t i = 0; i < boxes.size(); ++i) arrays_.set(i, boxes[i], static_cast<std::uint32_t>(i));
    for (std::size_t i = 0; i < boxes.size(); ++i) arrays_.match(i, i + 1, boxes.size(), pairs);
  }

 private:
  BoxArrays arrays_;
};

/// Sort along the axis where the boxes are spread most, then compare each box with those that start inside it.
class Sweep final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    const std::size_t n = boxes.size();
    const int axis = widest_axis(boxes);
    order_.resize(n);
    for (std::size_t i = 0; i < n; ++i) order_[i] = {boxes[i].min[axis], static_cast<std::uint32_t>(i)};
    std::sort(order_.begin(), order_.end());
    arrays_.resize(n);
    for (std::size_t i = 0; i < n; ++i) arrays_.set(i, boxes[order_[i].second], order_[i].second);

    const std::vector<float>& low = arrays_.low[axis];
    const std::vector<float>& high = arrays_.high[axis];
    for (std::size_t i = 0; i < n; ++i) {
      std::size_t end = i + 1;
      while (end < n && low[end] <= high[i]) ++end;
      arrays_.match(i, i + 1, end, pairs);
    }
  }

 private:
  static int widest_axis(Span<const Aabb> boxes) {
    int axis = 0;
    double largest = -1;
    for (int d = 0; d < 3; ++d) {
      double sum = 0, squares = 0;
      for (const Aabb& box : boxes) {
        const double centre = 0.5 * (static_cast<double>(box.min[d]) + static_cast<double>(box.max[d]));
        sum += centre;
        squares += centre * centre;
      }
      const double variance = squares - sum * sum / static_cast<double>(boxes.size());
      if (variance > largest) {
        largest = variance;
        axis = d;
      }
    }
    return axis;
  }

  std::vector<std::pair<float, std::uint32_t>> order_;
  BoxArrays arrays_;
};

}  // namespace

std::unique_ptr<Peer> make_brute_force() {
  return std::make_unique<BruteForce>();
}
std::unique_ptr<Peer> make_sweep() {
  return std::make_unique<Sweep>();
}

std::vector<PeerConfig> make_plain_peers() {
  std::vector<PeerConfig> peers;
  const auto add = [&peers](const char* name, std::unique_ptr<Peer> peer) {
    peers.push_back({name, name, 1, "", std::move(peer)});
  };
  add("sweep", make_sweep());
  add("tree", make_plain_tree());
  add("bare-loop", std::make_unique<BareLoop>());
  add("sorted-sweep", std::make_unique<SortedSweep>());
  add("brute", make_brute_force());
  return peers;
}

}  // namespace boxstream::bench
