// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/span.hpp>

#include "world/nearest_distance.hpp"
#include "world/nearest_sort.hpp"

namespace boxstream::detail {

/// The nearest few of all candidates below a limit, kept in order of their squared distances, which are cheap and
/// inexact. Those that go make sure only that nothing is lost below the cut.
template <class S, std::size_t Room>
class NearFew {
 public:
  /// Whatever the caller tells candidates by.
  struct Entry {
    S squared;
    std::uint32_t a;
    std::uint32_t b;
  };

  explicit NearFew(S limit, std::size_t room = Room) : limit_(limit), window_(0, limit), room_(room) {}

  bool wants(S squared) const { return squared <= window_.reach; }

  /// Only what it wants.
  void add(const Entry& entry) {
    std::size_t at = size_++;
    for (; at > 0 && entry.squared < entries_[at - 1].squared; --at) entries_[at] = entries_[at - 1];
    entries_[at] = entry;
    if (size_ <= room_) return;
    --size_;
    is_full_ = true;
    window_.reach = entries_[room_].squared;
  }

  const NearWindow<S>& window() const { return window_; }
  /// All are at no distance, as far as can be told: there is nothing to be looked for.
  bool is_tied() const { return window_.reach <= 0; }

  /// Candidates below this are all here.
  S cut() const { return is_full_ ? std::min(limit_, NearWindow<S>::cut_of(window_.reach)) : limit_; }

  /// Visits those below the cut in order. `resolve(entry)` is asked for as many as it takes; false from `visit` ends
  /// it.
  template <class Resolve, class Visit>
  bool visit_in_order(Resolve&& resolve, Visit&& visit) const {
    const S below = cut();
    NearCandidate<S> resolved[Room];
    std::size_t next = 0, first = 0, last = 0;
    while (first < last || next < size_) {
      if (first < last &&
          (next == size_ || entries_[next].squared > NearWindow<S>(0, resolved[first].distance).reach)) {
        if (!visit(resolved[first++])) return false;
        continue;
      }
      const NearCandidate<S> candidate = resolve(entries_[next++]);
      if (!(candidate.distance < below)) continue;
      std::size_t at = last++;
      for (; at > first && candidate < resolved[at - 1]; --at) resolved[at] = resolved[at - 1];
      resolved[at] = candidate;
    }
    return true;
  }

 private:
  S limit_;
  NearWindow<S> window_;
  std::size_t room_;  // Room at most
  bool is_full_ = false;
  std::size_t size_ = 0;
  Entry entries_[Room + 1];
};

/// The nearest candidates at a distance of at least the floor, collected in any order: all those below the cut, which
/// starts at the limit and falls whenever there is no more room. So what a band holds at last depends on how they came,
/// but whoever takes one band after another, each from the cut of the one before, gets all candidates in order.
///
/// Those at the floor itself, mostly pairs that touch, are kept apart and have room of their own.
template <class S>
class NearBand {
 public:
  using Candidate = NearCandidate<S>;

  /// `cut` is above the floor and the limit at most; `room` is at least 2.
  void start(S floor, S cut, std::size_t room, std::size_t room_at_floor) {
    floor_ = floor;
    room_ = room;
    room_at_floor_ = room_at_floor;
    at_floor_.clear();
    candidates_.clear();
    candidates_.reserve(room);
    cut_at(cut);
  }

  bool wants(S distance) const { return distance >= floor_ && distance < cut_; }

  /// Only what it wants.
  void add(const Candidate& candidate) {
    if (!(floor_ < candidate.distance)) {
      if (at_floor_.size() < room_at_floor_)
        at_floor_.push_back(candidate);
      else
        cut_at(floor_);
      return;
    }
    if (candidates_.size() == room_) lower_cut();
    if (candidate.distance < cut_) candidates_.push_back(candidate);
  }

  S cut() const { return cut_; }
  const NearWindow<S>& window() const { return window_; }
  /// There was no room for those at the floor: the band is of no use.
  bool is_tied() const { return !(floor_ < cut_); }

  std::size_t size() const { return at_floor_.size() + candidates_.size(); }

  /// False as soon as `visit` returns that.
  template <class Visit>
  bool visit_in_order(Visit&& visit) {
    for (std::vector<Candidate>* part : {&at_floor_, &candidates_})
      for (const Candidate& candidate : sorter_.sort(*part))
        if (!visit(candidate)) return false;
    return true;
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
    candidates_.erase(end, last);
    cut_at(cut);
  }

  S floor_ = 0;
  S cut_ = 0;
  NearWindow<S> window_{0, 0};
  std::size_t room_ = 0;
  std::size_t room_at_floor_ = 0;
  std::vector<Candidate> at_floor_;
  std::vector<Candidate> candidates_;
  NearSorter<S> sorter_;
};

}  // namespace boxstream::detail
