// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "formats/scene_json/load_scene.hpp"
#include "simulation/query/run.hpp"

namespace boxstream::query_test {
namespace {

using query::RunResult;

query::QueryScene shipped(const std::string& name, double factor) {
  return query::scaled(query::load_query_scene(scenes::shipped("query_" + name + ".json")), factor);
}

RunResult run(const query::QueryScene& scene, const std::string& manager, const std::optional<std::string>& compare,
              std::uint64_t steps) {
  return query::run(scene, manager, compare, steps, [](auto, auto, auto) {});
}

/// What all queries of a run found.
struct Found {
  std::uint64_t pairs = 0, contacts = 0, touching = 0, distances = 0;
};

Found found_in(const query::ManagerRun& run) {
  Found found;
  for (const query::StepResult& step : run.steps) {
    for (const query::QueryStep& q : step.queries) {
      found.pairs += q.pairs;
      found.contacts += q.contacts;
      found.touching += q.touching ? 1 : 0;
      found.distances += std::isfinite(q.distance) ? 1 : 0;
      EXPECT_EQ(q.failures, 0U);
      EXPECT_LE(q.pairs + q.skipped, q.callbacks);
    }
  }
  return found;
}

struct Small {
  const char* name;
  double factor;
  std::uint64_t steps;
};

class Scenes : public testing::TestWithParam<Small> {};

TEST_P(Scenes, OursAnswersAsBruteForceDoes) {
  const auto& [name, factor, steps] = GetParam();
  const RunResult result = run(shipped(name, factor), "boxstream", "naive", steps);
  EXPECT_EQ(result.answers_equal, true) << result.first_difference;
  ASSERT_EQ(result.managers.size(), 2U);
  const Found found = found_in(result.managers[0]);
  EXPECT_GT(found.pairs, 0U);
  EXPECT_GT(found.distances, 0U);
  if (std::string(name) != "convoy") {
    EXPECT_GT(found.contacts, 0U);
    EXPECT_GT(found.touching, 0U);
  }
  EXPECT_EQ(result.managers[0].steps.size(), steps);
  for (const query::ManagerRun& manager : result.managers)
    for (const query::StepResult& step : manager.steps)
      EXPECT_EQ(step.queries.size(), result.managers[0].steps[0].queries.size());
}

TEST_P(Scenes, AndAsFclsTreeDoes) {
  const auto& [name, factor, steps] = GetParam();
  const RunResult result = run(shipped(name, factor), "tree", "boxstream", steps / 2);
  EXPECT_EQ(result.answers_equal, true) << result.first_difference;
}

/// The same answers from fewer callbacks: fewer boxes touch where no shapes do.
TEST_P(Scenes, TightBoxesSaveCallbacks) {
  const auto& [name, factor, steps] = GetParam();
  const RunResult result = run(shipped(name, factor), "boxstream_tight", "boxstream", steps / 2);
  EXPECT_EQ(result.answers_equal, true) << result.first_difference;
  std::uint64_t callbacks[2] = {};
  for (int i = 0; i < 2; ++i)
    for (const query::StepResult& step : result.managers[static_cast<std::size_t>(i)].steps)
      for (const query::QueryStep& q : step.queries) callbacks[i] += q.callbacks;
  EXPECT_LT(callbacks[0], callbacks[1]);
}

INSTANTIATE_TEST_SUITE_P(Shipped, Scenes,
                         testing::Values(Small{"bins", 0.2, 40}, Small{"arm", 0.06, 60}, Small{"convoy", 0.15, 12}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Run, IsTheSameEveryTime) {
  const query::QueryScene scene = shipped("bins", 0.1);
  const RunResult a = run(scene, "boxstream", std::nullopt, 20), b = run(scene, "boxstream", std::nullopt, 20);
  EXPECT_FALSE(a.answers_equal.has_value());
  for (std::size_t s = 0; s < a.managers[0].steps.size(); ++s) {
    for (std::size_t q = 0; q < scene.queries.size(); ++q) {
      const query::QueryStep &x = a.managers[0].steps[s].queries[q], &y = b.managers[0].steps[s].queries[q];
      EXPECT_EQ(x.callbacks, y.callbacks);
      EXPECT_EQ(x.pairs, y.pairs);
      EXPECT_EQ(x.contacts, y.contacts);
      EXPECT_EQ(x.distance, y.distance);
    }
  }
}

TEST(Run, SizesAreThoseOfTheScenes) {
  const RunResult bins = run(shipped("bins", 1), "boxstream", std::nullopt, 1);
  ASSERT_EQ(bins.groups.size(), 2U);
  EXPECT_EQ(bins.groups[0].moving, 500U);
  EXPECT_EQ(bins.groups[0].objects, 505U);
  EXPECT_EQ(bins.groups[1].objects, 4U);
  const RunResult arm = run(shipped("arm", 1), "boxstream", std::nullopt, 1);
  EXPECT_EQ(arm.groups[1].objects, 5000U);
  EXPECT_EQ(arm.groups[1].moving, 0U);
}

/// All managers that FCL has, on a scene in which no boxes touch exactly.
TEST(Run, EveryManagerAnswersAsBruteForceDoes) {
  const query::QueryScene scene = shipped("arm", 0.02);
  for (const std::string& manager : query::manager_names()) {
    const RunResult result = run(scene, manager, "naive", 4);
    EXPECT_EQ(result.answers_equal, true) << manager << ": " << result.first_difference;
  }
}

}  // namespace
}  // namespace boxstream::query_test
