// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "accuracy/work_precision.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::accuracy_test {
namespace {

using namespace accuracy;

/// A ball that falls from rest for a second, with nothing to fall on.
Request falling(const std::vector<std::string>& knobs, const std::vector<std::string>& measures) {
  Request request;
  request.file = "falling.json";
  request.scene = nlohmann::json::parse(R"({
    "format": 1, "meta": {"name": "falling", "about": "a ball falls", "source": "closed form"},
    "time": {"dt": 0.015625, "steps": 64}, "world": {"gravity": [0, -8, 0], "bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]}},
    "shapes": [{"name": "ball", "type": "sphere", "radius": 0.5}],
    "bodies": [{"shape": "ball", "mass": 1, "position": [0, 0, 0]}],
    "checks": [{"metric": "lowest", "op": ">", "value": -9}]
  })");
  for (const std::string& knob : knobs) request.knobs.push_back(parse_knob(knob));
  for (const std::string& measure : measures) request.measures.push_back(parse_measure(measure));
  request.repeats = 2;
  return request;
}

Sweep run_quietly(const Request& request) {
  return run(request, [](const Stage&) {});
}

/// Steps of length h take a body that falls from rest g T (T + h) / 2 down in the time T.
double fallen(double h) {
  return 8 * 1 * (1 + h) / 2;
}

TEST(Sweep, ErrorsOfAFallAreThoseOfItsClosedForm) {
  const Sweep sweep = run_quietly(falling({"substeps=1,2,4"}, {"trajectory", "lowest"}));
  ASSERT_EQ(sweep.rows.size(), 3u);
  EXPECT_EQ(sweep.seconds, 1);
  // The finest steps end at 4 m; floats are off by some of it after so many.
  const double off = sweep.reference.error.back();
  EXPECT_LT(off, 2e-3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double h = 1.0 / 64 / (1 << i);
    EXPECT_NEAR(sweep.rows[i].series[0].last, fallen(h) - fallen(0), off) << sweep.rows[i].label;
    EXPECT_NEAR(sweep.rows[i].series[1].worst, -fallen(h), 2e-6) << sweep.rows[i].label;
    EXPECT_GT(sweep.rows[i].ms.median, 0);
    EXPECT_EQ(sweep.rows[i].failure, "");
  }
}

TEST(Sweep, ReferenceThatConvergesStandsEvenIfChecksSpeakOfTheScenesStep) {
  Request request = falling({"substeps=1,2"}, {"trajectory"});
  request.scene["checks"] = {{{"metric", "lowest"}, {"op", "<="}, {"value", -4.06}, {"at", "end"}}};
  const Sweep sweep = run_quietly(request);
  EXPECT_EQ(sweep.reference.failure, "");
  EXPECT_NE(sweep.reference.remark.find("breaks a check of the scene: lowest <= -4.06"), std::string::npos)
      << sweep.reference.remark;
  EXPECT_EQ(sweep.rows[0].unsound, "");
  EXPECT_NE(sweep.rows[1].unsound, "");
}

TEST(Sweep, DriftIsFromTheEnergyAtTheStart) {
  Request request = falling({"substeps=1,2"}, {"energy_drift", "missed_pairs"});
  request.scene["bodies"][0]["position"] = {0, 2, 0};
  const Sweep sweep = run_quietly(request);
  for (std::size_t i = 0; i < 2; ++i) {
    // From 16 J, a fall in steps of h ends with 32 h too little.
    const double h = 1.0 / 64 / (1 << i);
    EXPECT_NEAR(sweep.rows[i].series[0].last, 2 * h, 1e-5) << sweep.rows[i].label;
    EXPECT_EQ(sweep.rows[i].series[1].worst, 0);
  }
}

TEST(Sweep, EverySettingSimulatesTheSameTime) {
  const Sweep sweep = run_quietly(falling({"dt=1/64,1/32,1/128"}, {"lowest"}));
  EXPECT_EQ(sweep.rows[0].steps, 64u);
  EXPECT_EQ(sweep.rows[1].steps, 32u);
  EXPECT_EQ(sweep.rows[2].steps, 128u);
  EXPECT_NEAR(sweep.rows[1].series[0].last, -fallen(1.0 / 32), 2e-6);
}

TEST(Sweep, SeriesAreOverAllSteps) {
  const Series series = run_quietly(falling({"substeps=1"}, {"max_speed"})).rows[0].series[0];
  // 8 h, 16 h ... 512 h with h = 1 / 64.
  EXPECT_NEAR(series.worst, 8, 1e-5);
  EXPECT_NEAR(series.last, 8, 1e-5);
  EXPECT_NEAR(series.mean, 8.0 / 64 * 65 / 2, 1e-5);
  EXPECT_NEAR(series.p95, 8.0 / 64 * 61, 1e-5);
}

TEST(Sweep, KnowsTheSettingOfTheSceneItself) {
  EXPECT_EQ(run_quietly(falling({"iterations=5,10,20", "substeps=2,1"}, {"lowest"})).own, 3u);
  EXPECT_EQ(run_quietly(falling({"iterations=5,20"}, {"lowest"})).own, std::nullopt);
}

TEST(Sweep, LeavesOutSettingsOfTooMuchWork) {
  Request request = falling({"substeps=1,2,4", "iterations=5,10"}, {"lowest"});
  request.most_product = 20;
  const Sweep sweep = run_quietly(request);
  ASSERT_EQ(sweep.rows.size(), 5U);
  EXPECT_EQ(sweep.rows.back().label, "substeps=4 iterations=5");
}

TEST(Sweep, ReferenceKnowsItsError) {
  const Request request = falling({"substeps=1,2,4,8"}, {"trajectory"});
  const Sweep sweep = run_quietly(request);
  // Of first order, and what floats lose in 8192 steps.
  const double true_error = std::abs(double{sweep.reference.trajectory.frames.back().positions[0].y()} + fallen(0));
  EXPECT_GE(sweep.reference.error.back(), true_error);
  EXPECT_LT(sweep.reference.error.back(), 5 * true_error);
  EXPECT_TRUE(std::isinf(sweep.reference.holds));
  EXPECT_NEAR(*order_of_convergence(request, sweep, lines_of(request, sweep)[0], 0), 1, 0.1);
}

TEST(Sweep, ScenesOwnChecksDecideWhatIsSound) {
  Request request = falling({"substeps=1,8"}, {"trajectory"});
  // It falls 4.0625 m in steps of 1/64 s and 4.0078 m in steps of an eighth of that.
  request.scene["checks"] = {{{"metric", "lowest"}, {"op", ">"}, {"value", -4.03}, {"at", "always"}}};
  const Sweep sweep = run_quietly(request);
  EXPECT_NE(sweep.rows[0].unsound.find("lowest > -4.03"), std::string::npos) << sweep.rows[0].unsound;
  EXPECT_EQ(sweep.rows[1].unsound, "");
  EXPECT_EQ(front_of(request, sweep, 0), std::vector<std::size_t>{1});
}

TEST(Sweep, PlacesAreNoBetterForBeingHigh) {
  const Request request = falling({"substeps=1,2,4"}, {"highest.last"});
  const Sweep sweep = run_quietly(request);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(error_of(request, sweep, sweep.rows[i], 0), fallen(1.0 / 64 / (1 << i)) - fallen(0),
                sweep.reference.spread[0]);
}

TEST(Sweep, TruthIsBeforeTheReference) {
  Request request = falling({"substeps=1,4"}, {"y"});
  request.body_name = "0";
  request.truth.value = -fallen(1.0 / 64);
  const Sweep sweep = run_quietly(request);
  EXPECT_LT(error_of(request, sweep, sweep.rows[0], 0), error_of(request, sweep, sweep.rows[1], 0));
  EXPECT_EQ(sweep.reference.name, "");

  request.truth = {{{0.25, {0, -8 * 0.25 * (0.25 + 1.0 / 64) / 2, 0}}, {1, {0, -fallen(1.0 / 64), 0.5}}}, {}};
  request.measures = {parse_measure("truth")};
  const Sweep beside = run_quietly(request);
  EXPECT_NEAR(beside.rows[0].series[0].worst, 0.5, 1e-5);
  EXPECT_NEAR(beside.rows[0].series[0].mean, 0.25, 1e-5);

  request.body_name = "nobody";
  EXPECT_THROW(run_quietly(request), BadKnob);
  request.body_name = "";
  EXPECT_THROW(run_quietly(request), BadKnob);
}

TEST(Sweep, SimulatesLessWhereTheBudgetAllowsNoMoreAndNobodyAskedForATime) {
  Request request = falling({"substeps=1,2"}, {"lowest"});
  request.scene["time"]["steps"] = 1000000;
  request.budget = 0.1;
  const Sweep sweep = run_quietly(request);
  EXPECT_EQ(sweep.seconds_of_scene, 1000000.0 / 64);
  EXPECT_LT(sweep.seconds, sweep.seconds_of_scene);
  ASSERT_EQ(sweep.rows.size(), 2u);
  EXPECT_EQ(sweep.rows[0].steps % 12, 0u);
  EXPECT_DOUBLE_EQ(static_cast<double>(sweep.rows[0].steps) / 64, sweep.seconds);
  request.steps = 64;
  EXPECT_EQ(run_quietly(request).seconds, 1);
}

TEST(Sweep, SeeksTheCheapestWithinABound) {
  Request request = falling({"substeps=1,2,4,8,16"}, {"trajectory.last"});
  request.seek.emplace();
  request.seek->bound = 0.017;  // 0.0155 m with four substeps, twice that with two
  const Sweep sweep = run_quietly(request);
  EXPECT_LT(sweep.rows.size(), 5u);
  EXPECT_EQ(sweep.all_settings, 5u);
  const auto best = cheapest_within(request, sweep, 0, request.seek->bound);
  ASSERT_TRUE(best);
  EXPECT_EQ(sweep.rows[*best].label, "substeps=4");
}

TEST(Sweep, KeepsWhatWasMeasuredWhenStopped) {
  Request request = falling({"substeps=1,2,4"}, {"lowest"});
  request.truth.value = -4;  // no reference
  int asked = 0;
  request.stop = [&] { return ++asked > 100; };  // in the second run
  const Sweep sweep = run_quietly(request);
  EXPECT_TRUE(sweep.stopped);
  ASSERT_EQ(sweep.rows.size(), 1u);
  EXPECT_GT(sweep.rows[0].ms.median, 0);
}

TEST(Sweep, RefusesWhatTheSceneCannotHave) {
  EXPECT_THROW(run_quietly(falling({"substeps=0"}, {"lowest"})), scenes::SceneError);
  EXPECT_THROW(run_quietly(falling({"/bodies/7/mass=1"}, {"lowest"})), BadKnob);
  EXPECT_THROW(run_quietly(falling({"dt=0.0156"}, {"trajectory"})), BadKnob);
  EXPECT_NO_THROW(run_quietly(falling({"dt=0.0156"}, {"lowest"})));
  EXPECT_THROW(parse_measure("beauty"), BadKnob);
}

TEST(Sweep, TellsItsProgress) {
  std::size_t calls = 0, said = 0;
  run(falling({"substeps=1,2"}, {"trajectory"}), [&](const Stage& stage) {
    EXPECT_EQ(stage.done, calls++);
    said = stage.all;
  });
  // Three runs of the reference, a sampled run of each, and two timed runs of each and of the A/A control.
  EXPECT_EQ(calls, 3u + 2 + 2 * 3);
  EXPECT_EQ(said, calls);
}

}  // namespace
}  // namespace boxstream::accuracy_test
