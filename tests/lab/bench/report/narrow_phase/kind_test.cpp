// SPDX-License-Identifier: MIT
// Scores from answers, engines on poses with known truth, and experiments of this kind.
#include <gtest/gtest.h>

#include <cmath>

#include "experiment_kinds/kinds.hpp"
#include "narrow_phase/engine.hpp"
#include "narrow_phase/score.hpp"

namespace boxstream::report {
namespace {

using namespace narrow;
using How = Answer::How;

std::vector<Pose> with_truths(std::initializer_list<double> truths) {
  std::vector<Pose> poses;
  for (const double truth : truths) poses.push_back({{}, {}, truth, 2});
  return poses;
}

TEST(NarrowScore, CountsAndMeasures) {
  const auto poses = with_truths({1, 1, -1, -1, 1, 1});
  const std::vector<Answer> answers{{How::answered, 1.5}, {How::answered, -0.25}, {How::answered, -1},
                                    {How::answered, NAN}, {How::aborted, 0},      {How::threw, 0}};
  const Score depth = score(Query::depth, poses, answers);
  EXPECT_DOUBLE_EQ(depth.extra, 1.0 / 6);
  EXPECT_DOUBLE_EQ(depth.missed, 1.0 / 6);
  EXPECT_DOUBLE_EQ(depth.unanswered, 2.0 / 6);
  EXPECT_DOUBLE_EQ(depth.error_max, 0.625) << "of the size";
  EXPECT_EQ(depth.failure, "throws on 1 of 6; aborts on 1 of 6");
  const Score distance = score(Query::distance, poses, answers);
  EXPECT_DOUBLE_EQ(distance.error_max, 0.5) << "what touches has no distance";
}

TEST(NarrowScore, HasNoErrorsOfVerdictsAndOfNothing) {
  EXPECT_TRUE(std::isnan(score(Query::verdict, with_truths({1}), std::vector<Answer>{{How::answered, 1}}).error_max));
  const Score none = score(Query::depth, with_truths({1}), std::vector<Answer>{{How::no_end, 0}});
  EXPECT_TRUE(std::isnan(none.error_p95));
  EXPECT_EQ(none.failure, "no end on 1 of 1");
}

TEST(NarrowScore, TakesEitherVerdictWithinRounding) {
  const auto poses = with_truths({1e-15, -1e-15});
  const std::vector<Answer> answers{{How::answered, -1}, {How::answered, 1}};
  const Score score = narrow::score(Query::verdict, poses, answers);
  EXPECT_EQ(score.extra + score.missed, 0);
}

struct Promise {
  const char* engine;
  Query query;
  double gap;
  double error;
  double tolerance = 1e-10;
};

class Engines : public testing::TestWithParam<Promise> {};

/// Each with its best settings on poses that are easy: what is wrong here is how it is asked.
TEST_P(Engines, AreAskedRightly) {
  const auto [name, query, gap, error, tolerance] = GetParam();
  Tuning tuning;
  tuning.tolerance = tolerance;
  tuning.margin = 0;
  tuning.triangles = 5120;
  for (const char* pair : {"ball-ball", "ball-box"}) {
    const auto poses = make_poses({pair, gap, gap, false, 1, 5});
    const auto engine = make_engine(name, query, tuning, poses);
    for (std::size_t i = 0; i < poses.size(); ++i) {
      const double truth = query == Query::verdict ? (gap < 0 ? -1 : 1) : poses[i].truth;
      EXPECT_NEAR(engine(i), truth, error) << pair;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Engines,
    testing::Values(Promise{"fcl libccd", Query::distance, 0.1, 1e-9}, Promise{"fcl indep", Query::distance, 0.1, 1e-9},
                    Promise{"fcl libccd", Query::depth, -0.1, 1e-9}, Promise{"fcl indep", Query::verdict, -0.1, 0},
                    Promise{"fcl libccd signed", Query::depth, -0.1, 1e-5, 1e-6},
                    Promise{"fcl indep magnitude", Query::depth, -0.1, 1e-9},
                    Promise{"fcl libccd mesh", Query::distance, 0.1, 1e-3},
                    Promise{"fcl libccd meshes", Query::distance, 0.1, 2e-3},
                    Promise{"fcl libccd mesh halfway", Query::distance, 0.1, 5e-4},
                    Promise{"fcl libccd hull", Query::distance, 0.1, 1e-3}, Promise{"ccd", Query::distance, 0.1, 1e-10},
                    Promise{"ccd", Query::depth, -0.1, 1e-10}, Promise{"ccd gjk", Query::depth, -0.1, 1e-10},
                    Promise{"ccd mpr", Query::verdict, 0.1, 0}, Promise{"libccd gjk", Query::depth, -0.1, 1e-4},
                    Promise{"libccd mpr", Query::verdict, -0.1, 0}, Promise{"libccd gjk", Query::verdict, 0.1, 0},
                    Promise{"bullet epa", Query::depth, -0.1, 1e-6},
                    Promise{"bullet epa hulls", Query::distance, 0.1, 1e-6},
                    Promise{"bullet dispatcher", Query::depth, -0.1, 1e-6},
                    Promise{"bullet minkowski", Query::verdict, 0.1, 0}),
    [](const auto& given) {
      std::string name = given.param.engine;
      for (char& c : name) c = c == ' ' ? '_' : c;
      return name + "_" + std::to_string(given.index);
    });

TEST(EngineNames, AreRefusedIfNotKnown) {
  const auto poses = make_poses({"pill-box", 0.1, 0.1, false, 1, 1});
  for (const char* name :
       {"ode", "fcl", "fcl gjk", "fcl libccd fast", "fcl libccd hull", "ccd epa", "libccd", "bullet"})
    EXPECT_THROW(make_engine(name, Query::depth, {}, poses), std::invalid_argument) << name;
  EXPECT_THROW(make_engine("libccd gjk", Query::distance, {}, poses), std::invalid_argument);
}

Experiment experiment(const char* settings) {
  return {"P0.json", "P0", "title", "narrow", nlohmann::json::parse(settings)};
}

Results measured(const char* settings) {
  return run_experiment(experiment(settings), 1, [](const std::string&) {});
}

TEST(NarrowKind, MakesAPointOfEachSeriesAndValue) {
  const Results results = measured(R"({"query": "depth", "poses": 8, "knob": "tolerance", "values": [1e-2, 1e-6],
    "panels": [{"name": "one", "pair": "capsule-box", "gap": [-0.1, -0.2]}, {"name": "two", "pair": "ball-ball", "gap": [-0.1, -0.2]}],
    "series": {"a": {"engine": "ccd"}, "b": {"engine": "libccd gjk", "values": [1e-8], "panels": ["one"]}}})");
  std::string all;
  for (const Point& point : results.points) {
    all += point.panel + "/" + point.series + "/" + point.setting + " ";
    EXPECT_GT(point.cost.median, 0);
    EXPECT_EQ(point.values.size(), results.metrics.size());
    EXPECT_EQ(point.values[2], 0) << "wrong";
    EXPECT_LE(point.values[0], point.series == "a" ? point.x : 0.01) << "error_max";
    EXPECT_EQ(point.failure, "");
  }
  EXPECT_EQ(all, "one/a/0.01 one/a/1e-06 one/b/1e-08 two/a/0.01 two/a/1e-06 ");
  EXPECT_EQ(results.controls.size(), 2U);
}

TEST(NarrowKind, ShowsWhatDoesNotAnswer) {
  const Results results = measured(R"({"query": "verdict", "poses": 5, "knob": "iterations", "values": [1],
    "panels": [{"name": "one", "pair": "box-box", "gap": [-0.1, -0.1]}], "series": {"a": {"engine": "ccd gjk"}}})");
  ASSERT_EQ(results.points.size(), 1U);
  EXPECT_EQ(results.points[0].failure, "not sure on 5 of 5");
  EXPECT_TRUE(std::isnan(results.points[0].cost.median));
}

TEST(NarrowKind, NamesTheFileOfWhatIsWrong) {
  for (
      const char* settings :
      {"{}",
       R"({"query": "area", "poses": 1, "knob": "scale", "values": [1], "panels": [{"name": "p", "pair": "box-box"}], "series": {"a": {"engine": "ccd"}}})",
       R"({"query": "depth", "poses": 1, "knob": "colour", "values": [1], "panels": [{"name": "p", "pair": "box-box"}], "series": {"a": {"engine": "ccd"}}})",
       R"({"query": "depth", "poses": 1, "knob": "scale", "values": [1], "panels": [{"name": "p", "pair": "box"}], "series": {"a": {"engine": "ccd"}}})",
       R"({"query": "depth", "poses": 1, "knob": "scale", "values": [1], "panels": [{"name": "p", "pair": "box-box"}], "series": {"a": {"engine": "ccd", "panels": ["q"]}}})"}) {
    try {
      (void)measured(settings);
      ADD_FAILURE() << settings;
    } catch (const BadExperiment& error) {
      EXPECT_EQ(std::string(error.what()).rfind("P0.json: ", 0), 0U) << error.what();
    }
  }
}

}  // namespace
}  // namespace boxstream::report
