// SPDX-License-Identifier: MIT
// Simbody against closed forms, and experiments as they are read.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "accuracy/sweep.hpp"
#include "experiment_kinds/scene_request.hpp"
#include "format/experiment.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "pair_orders/exact_pairs.hpp"
#include "references/simbody.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::report_test {
namespace {

using namespace report;
using accuracy::Trajectory;
using nlohmann::json;

json scene_of(const std::string& rest, double dt, int steps, const json& gravity = {0, -9.81, 0}) {
  json scene = json::parse(R"({"format": 1, "meta": {"name": "made", "about": "made", "source": "closed form"}})");
  scene.update(json::parse(rest));
  scene["time"] = {{"dt", dt}, {"steps", steps}};
  scene["world"] = {{"gravity", gravity}, {"bounds", {{"min", {-9, -9, -9}}, {"max", {9, 9, 9}}}}};
  return scene;
}

Trajectory trajectory_of(const json& scene) {
  const scenes::Scene parsed = scenes::parse_scene(scene.dump(), "made.json");
  return simbody_trajectory(parsed, static_cast<std::uint64_t>(parsed.time.steps));
}

class Simbody : public testing::Test {
 protected:
  void SetUp() override {
    if (!simbody_is_built()) GTEST_SKIP() << "built without Simbody";
  }
};

TEST_F(Simbody, PendulumHasThePeriodOfTheEllipticIntegral) {
  // A bar of a metre, hinged at its end, let go from the side: 90 degrees.
  const double d = 0.5, inertia = (0.5 * 0.5 + 0.1 * 0.1) / 3 + d * d;
  const double period = 4 * std::comp_ellint_1(std::sin(std::numbers::pi / 4)) * std::sqrt(inertia / (9.81 * d));
  const Trajectory trajectory = trajectory_of(scene_of(R"({
    "shapes": [{"name": "bar", "type": "box", "half_extents": [0.5, 0.1, 0.1]}],
    "bodies": [{"name": "bar", "shape": "bar", "mass": 3, "position": [0.5, 0, 0]}],
    "joints": [{"type": "hinge", "a": "bar", "pivot": [0, 0, 0], "axis": [0, 0, 1]}]})",
                                                       period / 64, 64));
  ASSERT_EQ(trajectory.frames.size(), 64u);
  const auto& half = trajectory.frames[31].positions[0];
  EXPECT_NEAR(half.x(), -0.5, 1e-6);
  EXPECT_NEAR(half.y(), 0, 1e-6);
  EXPECT_NEAR(trajectory.frames[15].positions[0].y(), -0.5, 1e-6) << "a quarter: at the bottom";
  EXPECT_NEAR(trajectory.frames[63].positions[0].x(), 0.5, 1e-6);
  EXPECT_NEAR(trajectory.frames[63].positions[0].y(), 0, 1e-6);
}

TEST_F(Simbody, SymmetricTopPrecessesAtTheRateOfItsMomentum) {
  // Equal moments about x and z: the axis y goes round L once in 2 pi I / |L|, whatever its spin.
  const double mass = 2, across = mass * (0.25 + 1) / 3, along = mass * (0.25 + 0.25) / 3;
  const double momentum = std::hypot(across * 2, along * 9);
  const json scene = scene_of(R"({
    "shapes": [{"name": "top", "type": "box", "half_extents": [0.5, 1, 0.5]}],
    "bodies": [{"shape": "top", "mass": 2, "position": [0, 0, 0], "spin": [2, 9, 0]}]})",
                              2 * std::numbers::pi * across / momentum / 64, 64, {0, 0, 0});
  const Trajectory trajectory = trajectory_of(scene);
  const auto axis = [&](std::size_t frame) {
    return quatRotate(trajectory.frames[frame].rotations[0], btVector3(0, 1, 0));
  };
  EXPECT_NEAR((axis(63) - btVector3(0, 1, 0)).length(), 0, 1e-6);
  // Half way round it is the mirror image across L.
  const btVector3 l = btVector3(static_cast<btScalar>(across * 2), static_cast<btScalar>(along * 9), 0).normalized();
  EXPECT_NEAR((axis(31) - (2 * l.y() * l - btVector3(0, 1, 0))).length(), 0, 1e-6);
}

/// A rod that is thrown, with a ball joint in its middle, goes on as if it were one.
TEST_F(Simbody, JoinedBodiesStartInMotion) {
  const Trajectory trajectory = trajectory_of(scene_of(R"({
    "shapes": [{"name": "half", "type": "capsule", "radius": 0.1, "height": 0.6}],
    "bodies": [{"name": "left", "shape": "half", "mass": 1, "position": [0, -0.4, 0], "velocity": [2.8, 0, 0], "spin": [0, 0, 2]},
      {"name": "right", "shape": "half", "mass": 1, "position": [0, 0.4, 0], "velocity": [1.2, 0, 0], "spin": [0, 0, 2]}],
    "joints": [{"type": "ball", "a": "right", "b": "left", "pivot": [0, 0, 0]}]})",
                                                       0.0625, 16, {0, 0, 0}));
  ASSERT_EQ(trajectory.frames.size(), 16u);
  EXPECT_NEAR(trajectory.frames[15].positions[0].x(), 2 + 0.4 * std::sin(2), 1e-6);
  EXPECT_NEAR(trajectory.frames[15].positions[0].y(), -0.4 * std::cos(2), 1e-6);
  EXPECT_NEAR(trajectory.frames[15].positions[1].x(), 2 - 0.4 * std::sin(2), 1e-6);
}

/// Two balls of 1 kg on a spring swing at sqrt(2 k).
TEST_F(Simbody, SpringHasItsPeriod) {
  const Trajectory trajectory = trajectory_of(scene_of(R"({
    "shapes": [{"name": "ball", "type": "sphere", "radius": 0.1}],
    "bodies": [{"name": "a", "shape": "ball", "mass": 1, "position": [-1, 0, 0], "velocity": [1, 0, 0]},
      {"name": "b", "shape": "ball", "mass": 1, "position": [1, 0, 0], "velocity": [-1, 0, 0]}],
    "joints": [{"type": "spring", "a": "a", "b": "b", "pivot": [0, 0, 0], "stiffness": 8}]})",
                                                       std::numbers::pi / 64, 32, {0, 0, 0}));
  EXPECT_NEAR(trajectory.frames[7].positions[0].x(), -1 + 0.25, 1e-6) << "a quarter: v / w";
  EXPECT_NEAR(trajectory.frames[31].positions[0].x(), -1, 1e-6);
}

TEST_F(Simbody, BallFallsAsItShould) {
  const Trajectory trajectory =
      trajectory_of(scene_of(R"({"shapes": [{"name": "ball", "type": "sphere", "radius": 0.5}],
    "bodies": [{"shape": "ball", "density": 100, "position": [1, 2, 3], "velocity": [1, 0, -1]}]})",
                             0.0625, 16));
  EXPECT_NEAR(trajectory.frames[15].positions[0].x(), 2, 1e-6);
  EXPECT_NEAR(trajectory.frames[15].positions[0].y(), 2 - 9.81 / 2, 1e-6);
  EXPECT_NEAR(trajectory.frames[15].positions[0].z(), 2, 1e-6);
}

TEST_F(Simbody, ClosedLoopStaysClosed) {
  // A parallelogram of two equal rockers: the coupler never turns, and its middle goes on a circle of their length.
  const Trajectory trajectory = trajectory_of(scene_of(R"({
    "shapes": [{"name": "bar", "type": "box", "half_extents": [0.1, 0.5, 0.1]}, {"name": "beam", "type": "box", "half_extents": [1, 0.1, 0.1]}],
    "bodies": [{"name": "left", "shape": "bar", "mass": 1, "position": [-0.7, 0.4, 0], "rotation": {"axis": [0, 0, 1], "degrees": -36.869897645844}},
      {"name": "right", "shape": "bar", "mass": 1, "position": [1.3, 0.4, 0], "rotation": {"axis": [0, 0, 1], "degrees": -36.869897645844}},
      {"name": "beam", "shape": "beam", "mass": 1, "position": [0.6, 0.8, 0]}],
    "joints": [{"type": "hinge", "a": "left", "pivot": [-1, 0, 0], "axis": [0, 0, 1]},
      {"type": "hinge", "a": "right", "pivot": [1, 0, 0], "axis": [0, 0, 1]},
      {"type": "hinge", "a": "beam", "b": "left", "pivot": [-0.4, 0.8, 0], "axis": [0, 0, 1]},
      {"type": "hinge", "a": "beam", "b": "right", "pivot": [1.6, 0.8, 0], "axis": [0, 0, 1]}]})",
                                                       0.05, 20));
  double lowest = 1;
  for (const accuracy::Frame& frame : trajectory.frames) {
    EXPECT_NEAR(frame.positions[2].length(), 1, 1e-6);
    EXPECT_NEAR(std::abs(frame.rotations[2].w()), 1, 1e-6);
    lowest = std::min(lowest, double{frame.positions[2].y()});
  }
  EXPECT_LT(lowest, 0) << "it swings";
}

TEST_F(Simbody, RefusesWhatItWouldGetWrong) {
  const auto reason = [](const std::string& rest) -> std::string {
    try {
      trajectory_of(scene_of(rest, 0.01, 1));
    } catch (const BadExperiment& error) {
      return error.what();
    }
    return "";
  };
  const std::string ball = R"("shapes": [{"name": "ball", "type": "sphere", "radius": 1}])";
  const std::string one = R"(, "bodies": [{"name": "a", "shape": "ball", "mass": 1, "position": [0, 0, 0])";
  EXPECT_EQ(reason("{" + ball + one + R"(}], "joints": [{"type": "6dof", "a": "a", "pivot": [0, 0, 0]}]})"),
            "made.json: no reference by Simbody: a joint of type 6dof");
  EXPECT_EQ(reason("{" + ball + one + R"(}],
    "joints": [{"type": "hinge", "a": "a", "pivot": [0, 0, 0], "axis": [0, 0, 1], "limits": [-10, 10]}]})"),
            "made.json: no reference by Simbody: a hinge with limits or a motor");
  EXPECT_EQ(reason("{" + ball + one + R"(, "linear_damping": 0.1}]})"), "made.json: no reference by Simbody: damping");
  EXPECT_EQ(reason("{" + ball + one + R"(, "velocity": [0, 0, 1]}],
    "joints": [{"type": "ball", "a": "a", "pivot": [0, 1, 0]}]})"),
            "made.json: no reference by Simbody: velocities that its joints do not allow");
}

/// The engine's first order shows against it: half the step, half the error.
TEST_F(Simbody, EngineConvergesToIt) {
  Experiment experiment{"made.json", "made", "made", "scene", {}};
  experiment.settings = json::parse(R"({"knobs": {"substeps": [16, 32]}, "metrics": ["trajectory.last"],
    "reference": "simbody", "steps": 60})");
  const accuracy::Request request = request_of(experiment, "bench/report/scenes/s2_pendulum.json", 1);
  const accuracy::Sweep sweep = accuracy::run(request, [](const accuracy::Stage&) {});
  const double coarse = sweep.rows[0].series[0].last, fine = sweep.rows[1].series[0].last;
  EXPECT_LT(coarse, 2e-3);
  EXPECT_NEAR(coarse / fine, 2, 0.1);
}

TEST(SceneRequest, KnobsAreNamesOrPlaces) {
  const std::vector<accuracy::Knob> knobs = knobs_of(json::parse(R"([{"name": "dt", "values": ["1/64", 0.5]},
    {"name": "ccd", "at": "/bodies/*/ccd", "values": [false, {"threshold": 1, "radius": 1}], "labels": ["off", "on"]}])"));
  EXPECT_EQ(knobs[0].pointer, "/time/dt");
  EXPECT_EQ(knobs[0].values, (std::vector<json>{0.015625, 0.5}));
  EXPECT_EQ(accuracy::label(knobs, {knobs[0].values[0], knobs[1].values[1]}), "dt=0.015625 ccd=on");
  EXPECT_THROW(knobs_of(json::parse(R"([{"name": "dt", "values": [1], "labels": ["a", "b"]}])")), accuracy::BadKnob);
  EXPECT_THROW(knobs_of(json::parse(R"({"speed": [1]})")), accuracy::BadKnob);
}

TEST(SceneRequest, SaysWhatIsWrong) {
  Experiment experiment{"x.json", "x", "made", "scene", {}};
  experiment.settings = json::parse(R"({"knobs": {"substeps": [1]}, "metrics": [], "reference": "hearsay"})");
  EXPECT_THROW(request_of(experiment, "bench/report/scenes/none.json", 1), BadExperiment);
  try {
    request_of(experiment, "bench/report/scenes/s1_stable.json", 1);
    ADD_FAILURE() << "taken";
  } catch (const BadExperiment& error) {
    EXPECT_STREQ(error.what(), "x.json: reference \"hearsay\" is neither fine nor simbody");
  }
}

/// Friction mu g against the path of a plate that slides; a pyramid whose sides stand still turns it.
TEST(SceneKnobs, FrictionAlongTheWayKeepsTheDirection) {
  Experiment experiment{"made.json", "made", "made", "scene", {}};
  experiment.settings = json::parse(R"({"knobs": {"friction_directions": ["one", "two", "two_fixed"]},
    "metrics": ["velocity_error", "direction_error"],
    "expected": {"s5_slide": {"body": 1, "velocity": [2.2062, 0, 1.27375]}}})");
  accuracy::Request request = request_of(experiment, "bench/report/scenes/s5_slide.json", 1);
  request.scene["time"] = {{"dt", 0.002}, {"steps", 250}};
  const accuracy::Sweep sweep = accuracy::run(request, [](const accuracy::Stage&) {});
  for (const std::size_t i : {0, 1}) {
    EXPECT_LT(sweep.rows[i].series[0].last, 0.005) << sweep.rows[i].label;
    EXPECT_LT(sweep.rows[i].series[1].last, 0.1) << sweep.rows[i].label;
  }
  EXPECT_GT(sweep.rows[2].series[1].last, 20);
}

/// Bullet's three methods of stepping the gyroscopic torque: the explicit one adds energy, the implicit ones take some.
TEST(SceneKnobs, GyroscopicModesHaveTheirSigns) {
  Experiment experiment{"made.json", "made", "made", "scene", {}};
  experiment.settings = json::parse(R"({"knobs": [{"name": "gyro", "at": "/bodies/0/gyro",
    "values": [false, "explicit", "implicit_world", "implicit_body"]}], "metrics": ["energy_change.last"], "steps": 60})");
  accuracy::Request request = request_of(experiment, "bench/report/scenes/s1_middle.json", 1);
  request.scene["time"]["substeps"] = 8;
  const accuracy::Sweep sweep = accuracy::run(request, [](const accuracy::Stage&) {});
  EXPECT_NEAR(sweep.rows[0].series[0].last, 0, 1e-5);
  EXPECT_GT(sweep.rows[1].series[0].last, 0.001);
  EXPECT_LT(sweep.rows[2].series[0].last, -0.001);
  EXPECT_LT(sweep.rows[3].series[0].last, -0.001);
}

/// SimBenchmark's finding: without ERP Bullet leaves balls in each other.
TEST(SceneKnobs, ContactErpTakesBallsApart) {
  Experiment experiment{"made.json", "made", "made", "scene", {}};
  experiment.settings = json::parse(R"({"knobs": {"contact_erp": [0, 0.2]},
    "metrics": ["mean_square_penetration.last"], "steps": 100})");
  const accuracy::Request request = request_of(experiment, "bench/report/scenes/s4_grid_of_balls.json", 1);
  const accuracy::Sweep sweep = accuracy::run(request, [](const accuracy::Stage&) {});
  EXPECT_GT(sweep.rows[0].series[0].last, 10 * sweep.rows[1].series[0].last);
}

/// With the same pairs in the same order a broad-phase does not show; with its own it does.
TEST(ExactPairs, MakeBroadPhasesTheSame) {
  scenes::Scene scene = scenes::load_scene("bench/report/scenes/s4_grid_of_balls.json");
  const auto last_bits = [&](const std::string& broadphase, bool exact) {
    scenes::Simulation::Wrap wrap;
    if (exact)
      wrap = [](std::unique_ptr<btBroadphaseInterface> inner) -> std::unique_ptr<btBroadphaseInterface> {
        return std::make_unique<ExactPairs>(std::move(inner));
      };
    scenes::Simulation simulation(scene, broadphase, wrap);
    for (int step = 0; step < 20; ++step) simulation.advance();
    return simulation.state_hash();
  };
  EXPECT_EQ(last_bits("dbvt", true), last_bits("boxstream", true));
  EXPECT_EQ(last_bits("sap", true), last_bits("boxstream", true));
  EXPECT_NE(last_bits("dbvt", false), last_bits("boxstream", false));
}

}  // namespace
}  // namespace boxstream::report_test
