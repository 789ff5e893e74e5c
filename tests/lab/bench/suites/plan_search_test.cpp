// SPDX-License-Identifier: MIT
#include "suites/plan_search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "inputs/batches.hpp"

namespace boxstream::bench {
namespace {

TEST(PlanSearch, PlansDifferAndDoNotCutAnAxisTwice) {
  const int counts[] = {8, 64};
  const std::vector<detail::FixedPlan> plans = all_plans(counts);
  EXPECT_EQ(plans.size(), 3u * (1 + 3 * 2 * (1 + 2 * 2)));
  std::set<std::string> names;
  for (const detail::FixedPlan& plan : plans) {
    EXPECT_TRUE(names.insert(name_of(plan)).second) << name_of(plan);
    EXPECT_TRUE(plan.levels < 2 || plan.level[0].axis != plan.level[1].axis) << name_of(plan);
  }
  EXPECT_EQ(names.count("plan:z,x64,y8"), 1u);
  EXPECT_EQ(names.count("plan:y"), 1u);
}

TEST(PlannedSearch, FollowsThePlan) {
  const std::vector<Aabb> boxes = batches::make("D", 5000, 1);
  Detector detector;
  std::vector<Pair> pairs;
  detector.find_pairs(boxes, pairs);
  const PairSummary expected = summarize(pairs);
  PlannedSearch search;
  const Stats stats = search.find_pairs({2, 2, {{0, 4}, {1, 3}}}, boxes, pairs);
  EXPECT_EQ(stats.nodes, 1u) << "two axes are cut at once";
  EXPECT_EQ(stats.cells, 12u);
  EXPECT_EQ(summarize(pairs), expected);
  EXPECT_EQ(search.find_pairs({1, 0, {}}, boxes, pairs).cells, 1u);
  EXPECT_EQ(summarize(pairs), expected);
}

TEST(PlanSearch, TriesAllAndKeepsTheQuickest) {
  const std::vector<Aabb> boxes = batches::make("U", 3000, 1);
  Detector detector;
  std::vector<Pair> pairs;
  detector.find_pairs(boxes, pairs);
  const int counts[] = {4, 16};
  const auto plans = all_plans(counts);
  PlanSearch search(boxes, summarize(pairs));
  search.run(plans, 1e9, 1e9, 1);
  EXPECT_EQ(search.tried(), plans.size());
  EXPECT_TRUE(search.pairs_equal());
  const auto quickest = search.quickest(3);
  ASSERT_FALSE(quickest.empty());
  EXPECT_LE(quickest.size(), 3u);
  EXPECT_TRUE(std::is_sorted(quickest.begin(), quickest.end(), [](auto& a, auto& b) { return a.ms < b.ms; }));
}

TEST(PlanSearch, GivesUpPlansThatTakeTooLong) {
  const std::vector<Aabb> boxes = batches::make("D", 20000, 1);
  PlanSearch search(boxes, PairSummary{});
  search.run({{0, 0, {}}}, 1e-6, 1e9, 1);
  EXPECT_EQ(search.tried(), 1u);
  EXPECT_TRUE(search.quickest(1).empty());
  EXPECT_TRUE(search.pairs_equal());  // what was stopped is not compared
}

TEST(PlanSearch, NoticesWrongPairs) {
  const std::vector<Aabb> boxes = batches::make("U", 1000, 1);
  PlanSearch search(boxes, PairSummary{});
  search.run({{0, 0, {}}}, 1e9, 1e9, 1);
  EXPECT_FALSE(search.pairs_equal());
}

}  // namespace
}  // namespace boxstream::bench
