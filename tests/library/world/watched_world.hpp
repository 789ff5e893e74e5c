// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include "core/fast_oracle.hpp"
#include "core/oracle.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

/// Every way of searching that can be forced, and the World's own choice.
inline constexpr detail::SearchMode search_modes[] = {detail::SearchMode::probe, detail::SearchMode::all,
                                                      detail::SearchMode::candidates, detail::SearchMode::cheapest,
                                                      detail::SearchMode::beside};

/// A World beside the boxes that it was given. After each update, what began, what ended and what is held must be what
/// brute force says of the boxes now and before, in order, and every invariant must hold. Proxies are named by their
/// number of creation.
template <class S>
class WatchedWorld {
 public:
  using World = detail::WorldCore<S>;

  explicit WatchedWorld(detail::SearchMode mode = detail::SearchMode::cheapest, WorldOptions options = {})
      : world_(options, mode) {}

  void create(const Boxes<S>& boxes) {
    for (const auto& box : boxes) {
      ids_.push_back(world_.create(box, {}, boxes_.size()));
      boxes_.push_back(box);
    }
  }
  void move(std::uint32_t i, const BasicAabb<S>& box) {
    ASSERT_TRUE(world_.move(ids_[i], box));
    boxes_[i] = box;
  }
  void destroy(std::uint32_t i) {
    ASSERT_TRUE(world_.destroy(ids_[i]));
    boxes_[i] = {{1, 1, 1}, {0, 0, 0}};  // pairs with nothing, for brute force too
    destroyed_.push_back(i);
  }

  WorldStats update() {
    const WorldStats stats = world_.update();
    const Pairs now = boxes_.size() <= 600 ? brute_force(boxes_) : sweep(boxes_);
    Pairs begun, ended;
    std::set_difference(now.begin(), now.end(), held_.begin(), held_.end(), std::back_inserter(begun));
    std::set_difference(held_.begin(), held_.end(), now.begin(), now.end(), std::back_inserter(ended));
    held_ = now;
    EXPECT_NO_THROW(world_.validate());
    EXPECT_EQ(held(), now);
    EXPECT_EQ(numbers(world_.begun()), begun);
    EXPECT_EQ(numbers(world_.ended()), ended);
    EXPECT_EQ(stats.pairs, now.size());
    return stats;
  }

  /// The pairs that the World holds, in its order.
  Pairs held() const {
    std::vector<ProxyPair> pairs;
    world_.for_each_pair([&](ProxyPair pair) {
      pairs.push_back(pair);
      return true;
    });
    return numbers(pairs);
  }

  World& world() { return world_; }
  ProxyId id(std::uint32_t i) const { return ids_[i]; }

 private:
  Pairs numbers(Span<const ProxyPair> pairs) const {
    Pairs numbered;
    for (const ProxyPair pair : pairs) numbered.push_back({number(pair.a), number(pair.b)});
    return numbered;
  }

  /// Events may name proxies that are gone and have lost their user word.
  std::uint32_t number(ProxyId id) const {
    if (world_.contains(id)) return static_cast<std::uint32_t>(world_.user(id));
    for (const std::uint32_t i : destroyed_)
      if (ids_[i] == id) return i;
    ADD_FAILURE() << "an id that was never given";
    return 0;
  }

  World world_;
  Boxes<S> boxes_;
  std::vector<ProxyId> ids_;
  std::vector<std::uint32_t> destroyed_;
  Pairs held_;
};

}  // namespace boxstream::tests
