// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "world/nearest_distance.hpp"

namespace boxstream::detail {

/// How many candidates the next band may hold and where its cut should start, so that it is about filled.
template <class S>
class NearPlan {
 public:
  explicit NearPlan(std::size_t proxies)
      : proxies_(proxies), most_(std::clamp(room_per_proxy * proxies, first_room, room_of_all)) {}

  std::size_t room() const { return room_; }
  /// If there are more there are many, and it is time for other means.
  std::size_t room_at_floor() const { return std::max(room_, std::min(proxies_ / 2, most_)); }

  S cut(S floor, S limit) const {
    const S cut = floor + width_;
    return floor < cut && cut < limit ? cut : limit;
  }

  /// A band from `floor` to `cut` held so many. If these were few there is no telling how many come next.
  void learn(S floor, S cut, std::size_t count) {
    const bool filled = count >= room_ / 8;
    room_ = std::min(room_growth * room_, most_);
    constexpr S inf = std::numeric_limits<S>::infinity();
    width_ = filled ? (cut - floor) * (S(0.75) * static_cast<S>(room_) / static_cast<S>(count)) : inf;
  }

 private:
  static constexpr std::size_t first_room = 32;
  static constexpr std::size_t room_growth = 4;
  static constexpr std::size_t room_per_proxy = 64;
  static constexpr std::size_t room_of_all = std::size_t{1} << 20;

  std::size_t proxies_;
  std::size_t most_;
  std::size_t room_ = first_room;
  S width_ = std::numeric_limits<S>::infinity();
};

/// The candidates at one distance, of which there may be any number.
template <class S>
class NearExactly {
 public:
  explicit NearExactly(S distance) : distance_(distance), window_(distance, next_above(distance)) {}
  S distance() const { return distance_; }
  const NearWindow<S>& window() const { return window_; }
  static constexpr bool is_tied() { return false; }

 private:
  S distance_;
  NearWindow<S> window_;
};

}  // namespace boxstream::detail
