// SPDX-License-Identifier: MIT
#include "boxstream/advice/hard_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <fmt/format.h>

#include "boxstream/advice/coarse_steps.hpp"
#include "boxstream/advice/columns.hpp"
#include "boxstream/advice/hard_families.hpp"
#include "boxstream/advice/reaching.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/simulation.hpp"
#include "simulation/run/vitals.hpp"

namespace boxstream::tool_test {
namespace {

using scenes::Scene;
using tool::HardCase;

Scene shipped(const std::string& name) {
  return scenes::load_scene(scenes::shipped(name + ".json"));
}

std::vector<HardCase> cases_of(const std::string& name) {
  return tool::hard_cases(shipped(name));
}

Scene with(Scene scene, int substeps, int iterations) {
  scene.time.substeps = substeps;
  scene.solver.iterations = iterations;
  return scene;
}

/// A cube for each mass, the first on the ground.
Scene stack(const std::vector<double>& masses) {
  Scene scene = shipped("hard/mass_ratio_400");
  scene.bodies.resize(2);
  for (const double mass : masses) {
    scenes::Body& cube = scene.bodies.back();
    cube.traits.mass = mass;
    cube.position[1] = static_cast<double>(scene.bodies.size()) - 1.5;
    scene.bodies.push_back(cube);
  }
  scene.bodies.pop_back();
  return scene;
}

Scene chain(int links, double end) {
  Scene scene = shipped("hard/chain_40");
  auto& made = std::get<scenes::ChainGenerator>(scene.generators[0]);
  made.links = links;
  made.end.mass = end;
  return scene;
}

const tool::Family& usual(const std::map<scenes::SolverKind, tool::Family>& families) {
  return tool::family_of(families, scenes::SolverKind::sequential_impulses);
}

TEST(HardCases, NamesTheWorldThatASceneIs) {
  const std::pair<const char*, const char*> worlds[] = {{"ball_and_chain", "ball_and_chain_stable"},
                                                        {"bounce_energy", "bounce_energy"},
                                                        {"chain_40", "chain_40_stable"},
                                                        {"chain_160", "chain_160_stable"},
                                                        {"mass_ratio_400", "mass_ratio_1000_stable"},
                                                        {"mass_ratio_1000", "mass_ratio_1000_stable"},
                                                        {"stack_30", "stack_30_stable"},
                                                        {"thin_boxes_on_mesh", "thin_boxes_on_mesh_stable"}};
  for (const auto& [name, scene] : worlds) {
    const std::vector<HardCase> found = cases_of(std::string("hard/") + name);
    ASSERT_EQ(found.size(), 1u) << name;
    EXPECT_EQ(found[0].scene, scene) << name;
  }
}

TEST(HardCases, AreNotOfScenesWithTheirSettings) {
  for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped("hard"))) {
    const std::string name = entry.path().stem().string();
    if (name.ends_with("_stable")) {
      EXPECT_TRUE(cases_of("hard/" + name).empty()) << name;
    }
  }
}

TEST(HardCases, SayWhatOfTheSceneIsHard) {
  EXPECT_EQ(cases_of("hard/chain_160")[0].what,
            "a chain of 161 bodies with 160 times its own mass hanging from one: it stretches");
  EXPECT_EQ(cases_of("hard/mass_ratio_400")[0].what,
            "a stack of 2 bodies with 400 times its own mass upon one: it sinks in or falls");
  EXPECT_EQ(cases_of("hard/stack_30")[0].advice, "Scenes like this one held from 4 of 4 starts with 20 iterations");
  EXPECT_TRUE(cases_of("hard/pyramid_1240").empty());
  EXPECT_FALSE(cases_of("box3d_large_pyramid").empty());
}

// Each of these failed its criterion when it was run with these settings.
TEST(HardCases, AreFoundWhateverTheSettingsAre) {
  const std::pair<const char*, Scene> failing[] = {
      {"150 on 1", stack({1, 150})},
      {"1000 on 1, one step of many iterations", with(stack({1, 1000}), 1, 100)},
      {"1000 on 1, many steps of few iterations", with(stack({1, 1000}), 20, 5)},
      {"3000 on 1", with(stack({1, 3000}), 2, 50)},
      {"each ten times the one below", with(stack({1, 10, 100, 1000}), 2, 50)},
      {"each twice the one below", stack({1, 2, 4, 8, 16, 32, 64, 128})},
      {"10 links and 100", chain(10, 100)},
      {"40 links and 49", with(chain(40, 49), 1, 20)},
      {"40 links and 1000", with(chain(40, 1000), 4, 10)},
      {"78 links", with(chain(78, 1), 1, 20)},
      {"5 links and 1000", chain(5, 1000)},
      {"the net", with(shipped("box3d_joint_grid"), 3, 10)}};
  for (const auto& [what, scene] : failing) EXPECT_EQ(tool::hard_cases(scene).size(), 1u) << what;
  Scene slow = with(stack({1, 1000}), 2, 50);
  slow.time.dt = 1.0 / 30;
  EXPECT_EQ(tool::hard_cases(slow).size(), 1u);
}

// Of 20 cubes that may sleep all stand, and none does that is kept awake.
TEST(HardCases, AreOfStacksThatMayNotSleepToo) {
  Scene scene = stack(std::vector<double>(20, 1.0));
  EXPECT_TRUE(tool::hard_cases(scene).empty());
  for (scenes::Body& body : scene.bodies) body.traits.sleep = body.traits.type != scenes::BodyType::dynamic;
  const std::vector<HardCase> found = tool::hard_cases(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].what,
            "a stack of 20 bodies with 19 times its own mass upon one, kept awake: it sinks in or falls");
  EXPECT_TRUE(tool::hard_cases(with(scene, 2, 10)).empty());
}

TEST(HardCases, AreOfWorldsWhereTheHeavyOneIsBorne) {
  EXPECT_TRUE(tool::hard_cases(stack({1000, 1})).empty());
  Scene scene = stack({1, 1000});
  scene.world.gravity = {};
  EXPECT_TRUE(tool::hard_cases(scene).empty());
  // Not upon each other at the start.
  scene = stack({1, 1000});
  scene.bodies[2].position = {3, 5, 0};
  ASSERT_EQ(tool::hard_cases(scene).size(), 1u);
  EXPECT_EQ(tool::hard_cases(scene)[0].what,
            "bodies of 1 to 1e+03 kg: a heavy one (2) sinks into a light one (1) that it comes to rest on");
  // Too far aside to come there, unless it moves.
  scene.bodies[2].position = {10, 5, 0};
  EXPECT_TRUE(tool::hard_cases(scene).empty());
  scene.bodies[2].velocity = {-2, 0, 0};
  ASSERT_EQ(tool::hard_cases(scene).size(), 1u);
  for (scenes::Body& body : scene.bodies)
    if (body.traits.mass == 1) body.traits.mask = 2;
  EXPECT_TRUE(tool::hard_cases(scene).empty());
}

// What matters is how far a body falls in a step, as a fraction of its size.
TEST(HardCases, DependOnGravityAsOnTheStep) {
  Scene scene = stack(std::vector<double>(30, 1.0));
  ASSERT_EQ(tool::hard_cases(scene).size(), 1u);
  scene.world.gravity = {0, -1.6, 0};
  EXPECT_TRUE(tool::hard_cases(scene).empty());
}

TEST(HardCases, OfFastBodiesDependOnTheFallAndTheThickness) {
  Scene scene = shipped("hard/thin_boxes_on_mesh");
  EXPECT_EQ(tool::hard_cases(scene)[0].advice,
            "None fell through that moved at most a quarter of its thickness: 18 substeps");
  std::get<scenes::GridGenerator>(scene.generators[0]).origin[1] = 0.1;
  scene.time.substeps = 8;
  EXPECT_TRUE(tool::hard_cases(scene).empty());
}

// The advice is what the program has measured: it holds by its own measure, and nothing cheaper does.
TEST(HardFamilies, NameTheCheapestSettingsThatHold) {
  const tool::Families& families = tool::measured_families();
  for (const tool::Family* family : {&usual(families.stack), &usual(families.chain)})
    for (const std::size_t bodies : {2, 5, 12, 40, 100})
      for (const double load : {1.0, 7.0, 100.0, 1e4})
        for (const double rate : {30.0, 60.0, 100.0}) {
          SCOPED_TRACE(fmt::format("{} bodies, load {}, {} steps a second", bodies, load, rate));
          const tool::Column column{bodies, load};
          const std::optional<tool::Settings> settings = family->cheapest(column, {rate, 10});
          if (!settings) {
            EXPECT_FALSE(family->holds(column, {rate * 16, 100}));
            continue;
          }
          EXPECT_TRUE(family->holds(column, {rate * settings->substeps, settings->iterations}));
          EXPECT_FALSE(settings->substeps > 1 &&
                       family->holds(column, {rate * (settings->substeps / 2), settings->iterations}));
        }
}

// Stacks and chains between those that were measured.
TEST(HardFamilies, HoldWithTheSettingsThatAreNamed) {
  const tool::Families& families = tool::measured_families();
  const auto run = [](Scene scene, const tool::Settings& settings) {
    scene = with(std::move(scene), settings.substeps, settings.iterations);
    scenes::Simulation simulation(scene, "boxstream");
    scenes::VitalsMonitor vitals(simulation);
    for (int step = 0; step < scene.time.steps; ++step) simulation.advance(true), vitals.look();
    const std::vector<scenes::CheckResult> results = simulation.check_results();
    // Joints of the family open by no more than 5 % of a link.
    return vitals.vitals().joint_gap <= 0.025 &&
           std::all_of(results.begin(), results.end(), [](const auto& result) { return result.passed; });
  };
  for (const auto& [bodies, load] : {std::pair{2, 35.0}, {3, 150.0}, {5, 25.0}, {10, 35.0}, {22, 3.0}}) {
    SCOPED_TRACE(fmt::format("stack of {}, load {}", bodies, load));
    std::vector<double> masses(static_cast<std::size_t>(bodies), 1.0);
    masses.back() = load;
    const auto settings = usual(families.stack).cheapest({masses.size(), load}, {60, 10});
    ASSERT_TRUE(settings);
    EXPECT_GT(settings->substeps * settings->iterations, 10);
    EXPECT_TRUE(run(stack(masses), *settings));
  }
  for (const auto& [links, load] : {std::pair{4, 30.0}, {8, 15.0}, {15, 8.0}, {33, 1.0}, {60, 2.0}}) {
    SCOPED_TRACE(fmt::format("chain of {}, load {}", links, load));
    const auto settings = usual(families.chain).cheapest({static_cast<std::size_t>(links) + 1, load}, {60, 10});
    ASSERT_TRUE(settings);
    EXPECT_GT(settings->substeps * settings->iterations, 10);
    Scene scene = chain(links, load);
    const double lowest = scenes::Simulation(scene, "boxstream").metric(scenes::Check::Metric::lowest);
    scene.checks = {
        {scenes::Check::Metric::lowest, scenes::Check::Op::at_least, lowest - 0.025 * (links + 1), 0, false}};
    EXPECT_TRUE(run(scene, *settings));
  }
}

// What simulate says of them itself: scenes with settings that are said to hold have no joint apart, and lose no
// energy.
TEST(HardFamilies, ScenesWithSettingsThatHoldAreSound) {
  for (const char* name : {"hard/ball_and_chain_stable", "hard/chain_160_stable", "hard/chain_40_stable"}) {
    const Scene scene = shipped(name);
    scenes::Simulation simulation(scene, "boxstream");
    scenes::VitalsMonitor vitals(simulation);
    for (int step = 0; step < scene.time.steps; ++step) simulation.advance(true), vitals.look();
    EXPECT_EQ(scenes::unsound(vitals.vitals()), "") << name;
    EXPECT_LT(vitals.vitals().joint_share, scenes::most_joint_gap) << name;
  }
}

// 21 bodies and 1000 kg: an exact solver needs no substeps.
TEST(HardCases, NameASolverThatHoldsForLess) {
  const std::vector<HardCase> found = tool::hard_cases(chain(20, 1000));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].advice.find("with \"solver\": {\"kind\": \"dantzig\"} in one substep"), std::string::npos)
      << found[0].advice;
  for (const scenes::SolverKind kind : {scenes::SolverKind::dantzig, scenes::SolverKind::multibodies}) {
    Scene direct = chain(20, 1000);
    direct.solver.kind = kind;
    EXPECT_TRUE(tool::hard_cases(direct).empty());
  }
}

// A chain of 41 links that swings with 500 times their mass is beyond all other settings that were measured.
TEST(HardCases, NameMultibodiesForHeavyChainsThatSwing) {
  Scene scene = chain(40, 500);
  for (scenes::Generator& generator : scene.generators)
    if (auto* const links = std::get_if<scenes::ChainGenerator>(&generator)) links->direction = {0.5, -0.866, 0};
  const std::vector<HardCase> found = tool::hard_cases(scene);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].advice.find("\"multibodies\"} in one substep"), std::string::npos) << found[0].advice;
  scene.solver.kind = scenes::SolverKind::multibodies;
  EXPECT_TRUE(tool::hard_cases(scene).empty());
}

// Of 41 links and 10 times the mass at 60 steps a second, 50 iterations held and 100 did not.
TEST(HardFamilies, AreJudgedByTheFinestThatWasMeasured) {
  const tool::Family family{{2}, {{{60, 50}, {10}}, {{60, 100}, {5}}, {{120, 20}, {20}}}};
  EXPECT_TRUE(family.holds({2, 10}, {60, 50}));
  EXPECT_TRUE(family.holds({2, 10}, {60, 99}));
  EXPECT_FALSE(family.holds({2, 10}, {60, 100}));
  EXPECT_FALSE(family.holds({2, 10}, {100, 100}));
  EXPECT_TRUE(family.holds({2, 5}, {60, 100}));
  // Neither of two is finer than the other.
  EXPECT_TRUE(family.holds({2, 20}, {120, 100}));
}

TEST(HardFamilies, BearLessTheLongerTheyAreAndNothingBeyondWhatWasTried) {
  const tool::Families& families = tool::measured_families();
  for (const tool::Family* family : {&usual(families.stack), &usual(families.chain)}) {
    EXPECT_GE(family->rows.size(), 15u);
    for (const tool::Family::Row& row : family->rows) {
      ASSERT_EQ(row.loads.size(), family->bodies.size());
      EXPECT_TRUE(std::is_sorted(row.loads.rbegin(), row.loads.rend()));
    }
    EXPECT_FALSE(family->holds({family->bodies.back() + 1, 1}, {1e4, 1000}));
    EXPECT_FALSE(family->holds({2, 1e6}, {1e4, 1000}));
    EXPECT_FALSE(family->holds({2, 1}, {60, 1}));
  }
}

/// A ball of 0.5 kg on a spring, in steps of 1/100 s.
Scene on_spring(double stiffness, int substeps) {
  Scene scene = shipped("effects/nothing");
  scene.time.dt = 0.01;
  scene.time.substeps = substeps;
  scene.bodies[0].traits.mass = 0.5;
  scene.bodies[0].position = {0, 0, 0};
  scene.bodies[0].velocity = {1, 0, 0};
  scene.joints.push_back({0, std::nullopt, scenes::SpringJoint{{0, 0, 0}, stiffness, 0}, false});
  return scene;
}

/// Seconds between its first crossing of the middle and the third.
double swing(const Scene& scene) {
  scenes::Simulation simulation(scene, "boxstream");
  const btCollisionObject& ball = *simulation.objects()[0];
  double first = 0, before = 1;
  for (int step = 1, crossings = 0; step < 100'000; ++step) {
    simulation.advance();
    const double now = ball.getWorldTransform().getOrigin().x();
    if ((before < 0) != (now < 0)) {
      const double when = (step - 1 + before / (before - now)) * scene.time.dt;
      if (++crossings == 1) first = when;
      if (crossings == 21) return (when - first) / 10;
    }
    before = now;
  }
  return 0;
}

// 0.25 rad a step is a rate of 25 / s here: 312.5 N/m.
TEST(HardCases, WarnOfASpringThatSwingsTooFast) {
  EXPECT_TRUE(tool::hard_cases(on_spring(310, 1)).empty());
  const std::vector<HardCase> found = tool::hard_cases(on_spring(5000, 1));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].what,
            "a spring of 5e+03 N/m on 0.5 kg, which swings in 0.0628 s: Bullet makes it softer, until it swings in 25 "
            "substeps, 0.251 s");
  EXPECT_EQ(found[0].advice, "It is as stiff as it says with 4 substeps");
  EXPECT_TRUE(tool::hard_cases(on_spring(5000, 4)).empty());
  // That is what it does.
  EXPECT_NEAR(swing(on_spring(5000, 1)), 0.251, 0.005);
  EXPECT_NEAR(swing(on_spring(5000, 4)), 0.0628, 0.0006);
}

/// Cubes of 1 m, each as much to the side as the one below; 1 lets the lowest of them lose the others.
Scene leaning(std::size_t cubes, double share) {
  Scene scene = stack(std::vector<double>(cubes, 2.0));
  for (std::size_t i = 0; i < cubes; ++i) {
    scene.bodies[i + 1].position[2] = share * static_cast<double>(i) / static_cast<double>(cubes);
    scene.bodies[i + 1].traits.material.friction = 1;
    scene.bodies[i + 1].traits.sleep = false;
  }
  return scene;
}

double height_of_the_last(const Scene& scene) {
  scenes::Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 360; ++i) simulation.advance();
  return double{simulation.objects().back()->getWorldTransform().getOrigin().y()};
}

/// A body of half a metre on a hinge through the origin, which gravity, downwards, turns as far as axes and arms allow.
std::vector<tool::CoarseStep> on_a_hinge(const std::string& axis, const std::string& place, const std::string& motor) {
  return tool::coarse_steps(scenes::parse_scene(
      fmt::format(
          R"({{"format": 1, "meta": {{"name": "leaf", "about": "On a hinge."}}, "time": {{"dt": 0.0166667, "steps": 60}},
        "world": {{"gravity": [0, -9.81, 0], "bounds": {{"min": [-9, -9, -9], "max": [9, 9, 9]}}}},
        "shapes": [{{"name": "leaf", "type": "box", "half_extents": [0.45, 0.5, 0.02]}}],
        "bodies": [{{"name": "leaf", "shape": "leaf", "mass": 5, "position": {}}}],
        "joints": [{{"type": "hinge", "a": "leaf", "pivot": [0, 0, 0], "axis": {}{}}}]}})",
          place, axis, motor),
      "leaf"));
}

TEST(CoarseSteps, LookAtWhatTurnsAHinge) {
  EXPECT_TRUE(on_a_hinge("[0, 1, 0]", "[0.45, 0, 0]", "").empty()) << "a door does not swing";
  EXPECT_EQ(on_a_hinge("[0, 0, 1]", "[0.45, 0, 0]", "").size(), 1u) << "a flap does";
  const std::string fast = R"(, "motor": {"speed": 10, "max_force": 100})";
  EXPECT_TRUE(on_a_hinge("[0, 1, 0]", "[0, 0.5, 0]", fast).empty()) << "a turntable turns about its centre";
  EXPECT_EQ(on_a_hinge("[0, 1, 0]", "[0.45, 0.5, 0]", fast).size(), 1u);
}

/// 3 kg on a hinge about z, 0.8 m beside it. The body's own origin is in the hinge.
std::vector<tool::CoarseStep> beside_its_origin(const std::string& motor) {
  return tool::coarse_steps(scenes::parse_scene(
      fmt::format(
          R"({{"format": 1, "meta": {{"name": "lever", "about": "A lever."}}, "time": {{"dt": 0.0125, "steps": 60}},
        "world": {{"gravity": [0, -9.81, 0], "bounds": {{"min": [-9, -9, -9], "max": [9, 9, 9]}}}},
        "shapes": [{{"name": "ball", "type": "sphere", "radius": 0.2}},
          {{"name": "lever", "type": "compound", "children": [{{"shape": "ball", "position": [0, 0.8, 0]}}]}}],
        "bodies": [{{"name": "lever", "shape": "lever", "mass": 3, "position": [0, 0, 0],
          "rotation": {{"axis": [0, 0, 1], "degrees": 90}}}}],
        "joints": [{{"type": "hinge", "a": "lever", "pivot": [0, 0, 0], "axis": [0, 0, 1]{}}}]}})",
          motor),
      "lever"));
}

TEST(CoarseSteps, AreOfCentresOfMass) {
  const std::vector<tool::CoarseStep> swings = beside_its_origin("");
  ASSERT_EQ(swings.size(), 1u);
  EXPECT_EQ(swings[0].what,
            "a body swings 0.8 m from a joint, in steps of 0.0125 s: it slows down and rises less each time");
  // It takes 3 * 9.81 * 0.8 = 23.54 N m.
  const std::vector<tool::CoarseStep> gives = beside_its_origin(R"(, "motor": {"speed": 0, "max_force": 25})");
  ASSERT_EQ(gives.size(), 1u);
  EXPECT_EQ(gives[0].what, "a motor that holds a weight with 1.06 of the torque that it takes: it gives");
  EXPECT_TRUE(beside_its_origin(R"(, "motor": {"speed": 0, "max_force": 22})").empty()) << "too weak to hold it at all";
}

TEST(Leans, AreOfCentresOfMass) {
  // A wedge on a cube: its centre of mass is a third of its length from the upright side, which its origin is on.
  const Scene scene = scenes::parse_scene(
      R"({"format": 1, "meta": {"name": "wedge", "about": "A wedge on a cube."}, "time": {"dt": 0.0125, "steps": 60},
      "world": {"gravity": [0, -9.81, 0], "bounds": {"min": [-9, -9, -9], "max": [9, 9, 9]}},
      "shapes": [{"name": "cube", "type": "box", "half_extents": [1, 1, 1]},
        {"name": "wedge", "type": "hull",
          "points": [[0, 0, -1], [2, 0, -1], [0, 2, -1], [0, 0, 1], [2, 0, 1], [0, 2, 1]]}],
      "bodies": [{"shape": "cube", "mass": 4, "position": [0, 1, 0]},
        {"shape": "wedge", "mass": 2, "position": [-1, 2, 0]}]})",
      "wedge");
  const scenes::Expanded expanded = scenes::expand(scene);
  const effects::Subject subject{scene, expanded};
  const std::vector<tool::Lean> leans = tool::leans_of(subject, tool::masses_of(subject), {0, 1, 0});
  ASSERT_EQ(leans.size(), 1u);
  EXPECT_NEAR(leans[0].share, 1 - 2.0 / 3, 0.02);
}

TEST(CoarseSteps, NameAStackThatLeansSoThatItFalls) {
  EXPECT_TRUE(tool::coarse_steps(leaning(7, 0.4)).empty());
  EXPECT_TRUE(tool::coarse_steps(leaning(3, 0.8)).empty());
  const std::vector<tool::CoarseStep> found = tool::coarse_steps(leaning(7, 0.9));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].what.find("a stack of 7 bodies leans or overhangs by 0.9 of what lets it fall"), std::string::npos)
      << found[0].what;
  EXPECT_LT(height_of_the_last(leaning(7, 0.9)), 6);
  // What is said to hold it, does.
  EXPECT_TRUE(tool::coarse_steps(with(leaning(7, 0.9), 8, 10)).empty());
  EXPECT_NEAR(height_of_the_last(with(leaning(7, 0.9), 8, 10)), 6.5, 0.05);
  Scene exact = with(leaning(7, 0.9), 4, 10);
  exact.solver.kind = scenes::SolverKind::dantzig;
  EXPECT_TRUE(tool::coarse_steps(exact).empty());
  EXPECT_NEAR(height_of_the_last(exact), 6.5, 0.05);
}

}  // namespace
}  // namespace boxstream::tool_test
