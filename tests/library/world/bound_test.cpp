// SPDX-License-Identifier: MIT
// Updates of boxes that are hard to search: whatever a World looks through, it compares no more than n log^3 n + k.
#include <deque>

#include <gtest/gtest.h>

#include "core/hard_boxes.hpp"
#include "core/swift_sweep.hpp"
#include "sanitized.hpp"
#include "world/watched_world.hpp"

namespace boxstream::tests {
namespace {

/// Worlds of the same hard boxes, one for each way of searching. Which pairs they should hold a sweep says.
template <class S>
class HardWorlds {
 public:
  HardWorlds(std::string name, const Boxes<S>& boxes, Span<const detail::SearchMode> modes)
      : name_(std::move(name)), boxes_(boxes) {
    for (const auto mode : modes) worlds_.emplace_back(WorldOptions{}, mode);
    for (auto& world : worlds_)
      for (const auto& box : boxes_) ids_.push_back(world.create(box));
  }

  /// The same boxes, each end a step of the number away.
  void tremble() {
    move_by_one_step(boxes_, 1);
    for (std::size_t i = 0; i < boxes_.size(); ++i) tell(i);
  }

  /// One of `step` boxes changes places with the next of them.
  void swap(std::size_t step) {
    for (std::size_t i = 0; i + step < boxes_.size(); i += 2 * step) {
      std::swap(boxes_[i], boxes_[i + step]);
      tell(i);
      tell(i + step);
    }
  }

  void expect_bounded_update(const std::string& what) {
    const Pairs truth = swift_sweep(boxes_);
    for (std::size_t w = 0; w < worlds_.size(); ++w) {
      SCOPED_TRACE(name_ + ", world " + std::to_string(w) + ", " + what);
      const Stats search = worlds_[w].update().search;
      if (search.boxes > 1) {
        EXPECT_LE(work_by_bound(search), 1);
      }
      EXPECT_EQ(first_difference(held(worlds_[w]), truth, boxes_, boxes_), "");
    }
  }

 private:
  using World = detail::WorldCore<S>;

  void tell(std::size_t i) {
    for (std::size_t w = 0; w < worlds_.size(); ++w) worlds_[w].move(ids_[w * boxes_.size() + i], boxes_[i]);
  }

  static Pairs held(const World& world) {
    Pairs pairs;
    world.for_each_pair([&](ProxyPair pair) {
      pairs.push_back({pair.a.slot, pair.b.slot});
      return true;
    });
    return pairs;
  }

  std::string name_;
  Boxes<S> boxes_;
  std::deque<World> worlds_;  // which do not move
  std::vector<ProxyId> ids_;  // of one world after the other
};

template <class S>
class WorldBound : public testing::Test {
 protected:
  static void expect_bounded_life(const batches::HardFamily& family, std::size_t n,
                                  Span<const detail::SearchMode> modes) {
    HardWorlds<S> worlds(family.name, hard_boxes<S>(family, n, 1), modes);
    worlds.expect_bounded_update("new");
    worlds.tremble();
    worlds.expect_bounded_update("all tremble");
    for (const std::size_t step : {1, 100}) {
      worlds.swap(step);
      worlds.expect_bounded_update("one of " + std::to_string(step) + " moves");
    }
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(WorldBound, Scalars);

TYPED_TEST(WorldBound, InEveryWayOfSearching) {
  std::size_t i = 0;
  for (const batches::HardFamily& family : batches::hard_families()) {
    if (family.name.find("moved") != std::string::npos || (sanitized && i++ % 7 != 0)) continue;
    this->expect_bounded_life(family, 2000, search_modes);
  }
}

TYPED_TEST(WorldBound, OfManyProxies) {
  constexpr detail::SearchMode modes[] = {detail::SearchMode::all, detail::SearchMode::cheapest};
  for (const char* name :
       {"bars in 3 directions, 1 a line", "bars in 3 directions, short", "rods of 0.45 in 3 directions",
        "heap of 0.85 in a world of 10000.0", "heaps of 0.85, nested 9 deep", "mesh graded in 30 steps"})
    this->expect_bounded_life(batches::hard_family(name), sanitized ? 10000 : 100000, modes);
}

}  // namespace
}  // namespace boxstream::tests
