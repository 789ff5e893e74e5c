// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/span.hpp>

#include "world_nearest_distance.hpp"
#include "world_nearest_sort.hpp"

namespace boxstream::detail {

/// As NearBand below, for the nearest few: kept in order, without memory of its own.
template <class S, std::size_t Room>
class NearFew {
 public:
  using Candidate = NearCandidate<S>;

  NearFew(S floor, S limit) : floor_(floor), cut_(limit), window_(floor, limit) {}

  bool wants(S distance) const { return distance >= floor_ && distance < cut_; }

  void add(const Candidate& candidate) {
    std::size_t at = size_++;
    for (; at > 0 && candidate < candidates_[at - 1]; --at) candidates_[at] = candidates_[at - 1];
    candidates_[at] = candidate;
    if (size_ <= Room) return;
    cut_ = candidates_[Room].distance;
    window_ = NearWindow<S>(floor_, cut_);
    while (size_ > 0 && !(candidates_[size_ - 1].distance < cut_)) --size_;
  }

  S cut() const { return cut_; }
  const NearWindow<S>& window() const { return window_; }
  bool is_tied() const { return !(floor_ < cut_); }
  Span<const Candidate> sorted() const { return Span<const Candidate>(candidates_, size_); }

 private:
  S floor_;
  S cut_;
  NearWindow<S> window_;
  std::size_t size_ = 0;
  Candidate candidates_[Room + 1];
};

/// The nearest candidates at a distance of at least the floor, collected in any order: all those below the cut, which
/// starts at the limit and falls whenever there is no more room. So what a band holds at last depends on how they came,
/// but whoever takes one band after another, each from the cut of the one before, gets all candidates in order.
template <class S>
class NearBand {
 public:
  using Candidate = NearCandidate<S>;

  /// `cut` is above the floor and the limit at most; `room` is at least 2.
  void start(S floor, S cut, std::size_t room) {
    floor_ = floor;
    room_ = room;
    candidates_.clear();
    candidates_.reserve(room);
    cut_at(cut);
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
  bool is_tied() const { return !(floor_ < cut_); }

  Span<const Candidate> sorted() { return sorter_.sort(candidates_); }

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
    candidates_.erase(end, last);
    cut_at(cut);
  }

  S floor_ = 0;
  S cut_ = 0;
  NearWindow<S> window_{0, 0};
  std::size_t room_ = 0;
  std::vector<Candidate> candidates_;
  NearSorter<S> sorter_;
};

}  // namespace boxstream::detail
