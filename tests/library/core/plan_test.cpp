// SPDX-License-Identifier: MIT
// Plans made by hand, as the benchmark's search for the best one makes them: they change the work, not the pairs.
#include <gtest/gtest.h>

#include "batch/search_by_plan.hpp"
#include "box_sets.hpp"
#include "checks.hpp"

namespace boxstream::tests {
namespace {

TEST(FixedPlan, ChangesTheWorkAndNotThePairs) {
  Detector detector;
  detail::Arena arena;
  for (const char* name : {"dense", "rods_mixed", "ties"}) {
    const auto boxes = box_set<float>(name).make(3000, 1), others = box_set<float>(name).make(1000, 2);
    const Pairs truth = brute_force(boxes);
    Pairs found, cross;
    detector.find_pairs(boxes, others, cross);
    std::sort(cross.begin(), cross.end());
    const std::uint64_t tests = detector.find_pairs(boxes, found).tests;
    bool has_changed = false;
    for (int axis = 0; axis < 3; ++axis)
      for (int levels = 0; levels <= 2; ++levels) {
        detail::FixedPlan plan;
        plan.sweep_axis = axis;
        plan.levels = levels;
        plan.level[0] = {(axis + 1) % 3, 8};
        plan.level[1] = {(axis + 2) % 3, 4};
        const auto collect = [&](Span<const Pair> pairs) {
          found.insert(found.end(), pairs.begin(), pairs.end());
          return true;
        };
        found.clear();
        const detail::Input<float> one{boxes, boxes, {}, {}, true}, two{boxes, others, {}, {}, false};
        if (detail::search_by_plan(plan, one, arena, collect).tests != tests) has_changed = true;
        SCOPED_TRACE(testing::Message() << "axis " << axis << ", levels " << levels);
        expect_same_pairs(found, truth, boxes, name, 1);
        found.clear();
        detail::search_by_plan(plan, two, arena, collect);
        std::sort(found.begin(), found.end());
        EXPECT_EQ(found, cross) << name;
      }
    EXPECT_TRUE(has_changed) << name;
  }
}

}  // namespace
}  // namespace boxstream::tests
