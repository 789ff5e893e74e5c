// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "world_nearest_distance.hpp"

namespace boxstream::detail {

/// The nearest candidates at a distance of at least the floor, collected in any order: all those below the cut, which
/// starts at the limit and falls whenever there is no more room. So what a band holds at last depends on how they came,
/// but whoever takes one band after another, each from the cut of the one before, gets all candidates in order.
template <class S>
class NearBand {
 public:
  struct Candidate {
    S distance;
    std::uint32_t a;  // ranks, which settle ties
    std::uint32_t b;

    friend bool operator<(const Candidate& x, const Candidate& y) {
      if (x.distance != y.distance) return x.distance < y.distance;
      return x.a != y.a ? x.a < y.a : x.b < y.b;
    }
  };

  /// `room` is at least 2.
  void start(S floor, S limit, std::size_t room) {
    floor_ = floor;
    room_ = room;
    is_tied_ = false;
    candidates_.clear();
    candidates_.reserve(room);
    cut_at(limit);
  }

  bool wants(S distance) const { return distance >= floor_ && distance < cut_; }

  /// Only what it wants.
  void add(const Candidate& candidate) {
    if (candidates_.size() == room_) lower_cut();
    if (candidate.distance < cut_) candidates_.push_back(candidate);
  }

  S cut() const { return cut_; }
  const NearWindow<S>& window() const { return window_; }
  /// More candidates than there is room for are at the floor itself: the band is of no use.
  bool is_tied() const { return is_tied_; }

  const std::vector<Candidate>& sorted() {
    std::sort(candidates_.begin(), candidates_.end());
    return candidates_;
  }

 private:
  void cut_at(S cut) {
    cut_ = cut;
    window_ = NearWindow<S>(floor_, cut);
  }

  /// Keeps the nearer half, or those that are nearest of all if these are more.
  void lower_cut() {
    const auto nearer = [](const Candidate& x, const Candidate& y) { return x.distance < y.distance; };
    const auto first = candidates_.begin(), last = candidates_.end();
    const auto middle = first + static_cast<std::ptrdiff_t>(room_ / 2);
    std::nth_element(first, middle, last, nearer);
    S cut = middle->distance;
    auto end = std::partition(first, middle, [=](const Candidate& c) { return c.distance < cut; });
    if (end == first) {
      const auto others = std::partition(middle, last, [=](const Candidate& c) { return !(cut < c.distance); });
      if (others != last) {
        cut = std::min_element(others, last, nearer)->distance;
        end = others;
      }
    }
    is_tied_ = end == first && !(floor_ < cut);
    candidates_.erase(end, last);
    cut_at(cut);
  }

  S floor_ = 0;
  S cut_ = 0;
  NearWindow<S> window_{0, 0};
  std::size_t room_ = 0;
  bool is_tied_ = false;
  std::vector<Candidate> candidates_;
};

}  // namespace boxstream::detail
