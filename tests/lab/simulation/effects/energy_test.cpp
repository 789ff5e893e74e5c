// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_json/load_scene.hpp"
#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

// No step of any world gains energy that nothing put in.
namespace boxstream::effects_test {
namespace {

using nlohmann::json;
using scenes::EnergyBalance;
using scenes::Simulation;

json box(const char* name, const json& half_extents) {
  return {{"name", name}, {"type", "box"}, {"half_extents", half_extents}};
}

/// A world with weight, a floor whose top is at 0, and nothing else.
json world_with_floor(double dt, int steps) {
  return {{"format", 1},
          {"meta", {{"name", "energy"}, {"about", "Energy."}}},
          {"time", {{"dt", dt}, {"steps", steps}}},
          {"world", {{"gravity", {0, -9.81, 0}}, {"bounds", {{"min", {-60, -60, -60}}, {"max", {60, 60, 60}}}}}},
          {"shapes", {box("floor", {40, 2, 40})}},
          {"bodies", {{{"name", "floor"}, {"shape", "floor"}, {"type", "static"}, {"position", {0, -2, 0}}}}}};
}

/// Upright dominoes in a row, of which the first leans on the next.
json dominoes(double dt, int count) {
  json document = world_with_floor(dt, static_cast<int>(std::lround(10 / dt)));
  document["shapes"].push_back(box("domino", {0.05, 0.5, 0.25}));
  for (int i = 0; i < count; ++i) {
    json domino{{"shape", "domino"}, {"mass", 1}, {"position", {0.4 * i, 0.5, 0}}};
    if (i == 0) {
      domino["position"][0] = -0.25;
      domino["rotation"] = {{"axis", {0, 0, 1}}, {"degrees", -18}};
    }
    document["bodies"].push_back(domino);
  }
  return document;
}

/// Bodies turned at random that fall on a heap.
json falling(double dt, double height, const json& half_extents, int count, int seed) {
  json document = world_with_floor(dt, static_cast<int>(std::lround(4 / dt)));
  document["world"]["seed"] = seed;
  document["shapes"].push_back(box("plate", half_extents));
  document["generators"] = {{{"type", "grid"},
                             {"count", count},
                             {"columns", {5, 4}},
                             {"spacing", {1, 1, 1}},
                             {"origin", {0, height, 0}},
                             {"turned", true},
                             {"mix", {{{"shape", "plate"}, {"mass", 1}}}}}};
  return document;
}

std::string told(const EnergyBalance& balance) {
  if (!balance.worst) return "no gain";
  return std::to_string(balance.gains) + " gains, the worst in step " + std::to_string(balance.worst->step) + ": " +
         std::to_string(balance.worst->energy) + " J, share " + std::to_string(balance.worst->share) + ", body " +
         std::to_string(balance.worst->body);
}

EnergyBalance balance_of(const scenes::Scene& scene, int steps) {
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < steps; ++i) simulation.step({.events = false, .hash = false});
  return simulation.energy_balance();
}
EnergyBalance balance_of(const json& document) {
  const scenes::Scene scene = scene_of(document);
  return balance_of(scene, scene.time.steps);
}

void expect_no_gain(const json& document) {
  const EnergyBalance balance = balance_of(document);
  EXPECT_EQ(balance.gains, 0U) << told(balance) << "\n" << document.dump();
}

TEST(Energy, OfDominoesOnlyFalls) {
  for (const double dt : {0.1, 0.05, 1.0 / 30, 1.0 / 60})
    for (const int count : {5, 15, 25}) {
      SCOPED_TRACE(dt);
      expect_no_gain(dominoes(dt, count));
    }
}

TEST(Energy, OfPlatesThatFallOnEachOtherOnlyFalls) {
  for (const double height : {2.0, 5.0, 12.0})
    for (const int seed : {11, 12, 13}) {
      SCOPED_TRACE(height);
      expect_no_gain(falling(1.0 / 60, height, {0.3, 0.01, 0.3}, 50, seed));
      expect_no_gain(falling(1.0 / 30, height, {0.2, 0.1, 0.1}, 50, seed));
    }
}

/// Bodies of all kinds, with what they do left to chance; they neither bounce nor hang together.
class ScenesLeftToChance {
 public:
  explicit ScenesLeftToChance(unsigned seed) : random_(seed) {}

  json document() {
    const double dt = any({0.1, 1.0 / 30, 1.0 / 60, 1.0 / 60, 1.0 / 120});
    json scene = world_with_floor(dt, static_cast<int>(std::lround(3 / dt)));
    if (chance(0.15)) scene["world"]["gravity"] = {0, 0, 0};
    if (chance(0.2)) {
      scene["shapes"][0] = {{"name", "floor"}, {"type", "plane"}, {"normal", {0, 1, 0}}};
      scene["bodies"][0]["position"] = {0, 0, 0};
    }
    scene["materials"]["rough"] = {{"friction", any({0.0, 0.2, 0.5, 1.0})}, {"rolling", any({0.0, 0.0, 0.1})}};
    scene["bodies"][0]["material"] = "rough";
    const double size = any({0.1, 0.3, 1.0});
    scene["shapes"].push_back({{"name", "ball"}, {"type", "sphere"}, {"radius", size / 2}});
    scene["shapes"].push_back(box("cube", {size / 2, size / 2, size / 2}));
    scene["shapes"].push_back(box("plank", {size, size / 10, size / 3}));
    scene["shapes"].push_back({{"name", "capsule"}, {"type", "capsule"}, {"radius", size / 4}, {"height", size}});
    scene["shapes"].push_back({{"name", "can"}, {"type", "cylinder"}, {"radius", size / 2}, {"height", size}});
    const int count = 2 + static_cast<int>(random_() % 30);
    const double span = size * std::cbrt(count) * any({1.0, 2.0, 4.0});
    for (int i = 0; i < count; ++i) {
      json b{{"shape", any<const char*>({"ball", "cube", "plank", "capsule", "can"})},
             {"mass", any({0.5, 1.0, 1.0, 4.0})},
             {"material", "rough"},
             {"position", {number(-span, span), size + number(0, 2 * span), number(-span, span)}},
             {"rotation", {{"axis", {number(-1, 1), number(-1, 1), 1.0}}, {"degrees", number(0, 180)}}}};
      if (chance(0.3)) b["velocity"] = {number(-5, 5), number(-5, 5), number(-5, 5)};
      if (chance(0.05)) b["velocity"] = {number(-40, 40), number(-40, 0), number(-40, 40)};
      if (chance(0.2)) b["spin"] = {number(-5, 5), number(-5, 5), number(-5, 5)};
      scene["bodies"].push_back(b);
    }
    return scene;
  }

 private:
  bool chance(double probability) { return number(0, 1) < probability; }
  double number(double low, double high) { return low + (high - low) * (random_() / 4294967296.0); }
  template <class T>
  T any(std::initializer_list<T> choices) {
    return choices.begin()[random_() % choices.size()];
  }

  std::mt19937 random_;
};

/// How many, by BOXSTREAM_ENERGY_SCENES.
unsigned scenes_left_to_chance() {
  const char* const number = std::getenv("BOXSTREAM_ENERGY_SCENES");
  return number == nullptr ? 40 : static_cast<unsigned>(std::max(1, std::atoi(number)));
}

TEST(Energy, OfScenesLeftToChanceOnlyFalls) {
  std::uint64_t steps = 0;
  for (unsigned seed = 0; seed < scenes_left_to_chance(); ++seed) {
    SCOPED_TRACE(seed);
    const json document = ScenesLeftToChance(seed).document();
    const EnergyBalance balance = balance_of(document);
    steps += balance.steps;
    EXPECT_EQ(balance.gains, 0U) << told(balance);
  }
  EXPECT_GT(steps, 1000U);
}

// The account finds what it is there to find.
TEST(Energy, ThatComesOutOfAnOverlapIsToldOf) {
  json document = world_with_floor(1.0 / 60, 60);
  document["solver"]["split_impulse"] = false;
  document["shapes"].push_back(box("cube", {0.5, 0.5, 0.5}));
  document["bodies"].push_back({{"shape", "cube"}, {"mass", 1}, {"position", {10, 0.5, 0}}});
  document["bodies"].push_back({{"shape", "cube"}, {"mass", 1}, {"position", {0, 0.1, 0}}});
  const EnergyBalance pushed = balance_of(document);
  ASSERT_TRUE(pushed.worst);
  EXPECT_GE(pushed.gains, 1U);
  EXPECT_EQ(pushed.worst->body, 2U);
  EXPECT_LE(pushed.worst->step, 3U);
  EXPECT_GT(pushed.worst->share, 0.05);

  document["solver"]["split_impulse"] = true;
  const EnergyBalance moved = balance_of(document);
  EXPECT_FALSE(moved.worst) << told(moved);
  EXPECT_NEAR(moved.work.apart, 9.81 * 0.4, 0.4) << "it was lifted";
}

/// One body, no weight, nothing to touch.
json alone(int steps) {
  json document = world_with_floor(1.0 / 60, steps);
  document["world"]["gravity"] = {0, 0, 0};
  document["bodies"] = json::array();
  return document;
}

TEST(Energy, OfAMotorIsItsWork) {
  json document = alone(100);
  document["shapes"].push_back(box("wheel", {0.5, 0.5, 0.1}));
  document["bodies"] = {{{"name", "wheel"}, {"shape", "wheel"}, {"mass", 3}, {"position", {0, 0, 0}}}};
  document["joints"] = {{{"type", "hinge"},
                         {"a", "wheel"},
                         {"pivot", {0, 0, 0}},
                         {"axis", {0, 0, 1}},
                         {"motor", {{"speed", 4}, {"max_force", 2}}}}};
  const EnergyBalance balance = balance_of(document);
  EXPECT_NEAR(balance.now, 3.0 * (1 + 1) / 12 / 2 * 16, 0.05) << "moment of inertia 0.5 kg m^2";
  EXPECT_NEAR(balance.work.motors, balance.now, 1e-3 * balance.now);
  EXPECT_EQ(balance.gains, 0U) << told(balance);
}

TEST(Energy, OfAFieldIsItsWork) {
  json document = alone(100);
  document["shapes"].push_back({{"name", "ball"}, {"type", "sphere"}, {"radius", 0.5}});
  document["bodies"] = {{{"name", "ball"}, {"shape", "ball"}, {"mass", 1}, {"position", {0, 0, 0}}}};
  document["fields"] = {{{"type", "wind"}, {"velocity", {8, 0, 0}}}};
  const EnergyBalance balance = balance_of(document);
  EXPECT_GT(balance.now, 0.5);
  EXPECT_NEAR(balance.work.fields, balance.now, 1e-3 * balance.now);
  EXPECT_EQ(balance.gains, 0U) << told(balance);
}

// What a wall of a given speed v pushes, without a bounce, gets m v^2 / 2 and costs it m v^2.
TEST(Energy, OfAKinematicBodyIsItsWork) {
  json document = alone(100);
  document["solver"]["split_impulse"] = false;
  document["shapes"].push_back(box("wall", {0.5, 2, 2}));
  document["shapes"].push_back({{"name", "ball"}, {"type", "sphere"}, {"radius", 0.5}});
  document["materials"]["smooth"] = {{"friction", 0}};
  document["bodies"] = {{{"shape", "ball"}, {"mass", 2}, {"material", "smooth"}, {"position", {0, 0, 0}}},
                        {{"shape", "wall"},
                         {"type", "kinematic"},
                         {"material", "smooth"},
                         {"position", {-1.5, 0, 0}},
                         {"velocity", {1.5, 0, 0}}}};
  const EnergyBalance balance = balance_of(document);
  EXPECT_NEAR(balance.now, 2 * 1.5 * 1.5 / 2, 0.15);
  EXPECT_NEAR(balance.work.surfaces, 2 * 1.5 * 1.5, 0.15);
  EXPECT_EQ(balance.gains, 0U) << told(balance);
}

// Half of what a belt gives is lost while it rubs.
TEST(Energy, OfABeltIsItsWork) {
  json document = world_with_floor(1.0 / 60, 120);
  document["materials"]["rough"] = {{"friction", 0.7}};
  document["shapes"].push_back(box("crate", {0.3, 0.3, 0.3}));
  document["bodies"][0]["surface_velocity"] = {2, 0, 0};
  document["bodies"][0]["material"] = "rough";
  document["bodies"].push_back({{"shape", "crate"}, {"mass", 2}, {"material", "rough"}, {"position", {0, 0.3, 0}}});
  const EnergyBalance balance = balance_of(document);
  EXPECT_NEAR(balance.now - balance.first, 2 * 2 * 2 / 2, 0.2);
  EXPECT_NEAR(balance.work.surfaces, 2 * 2 * 2, 0.4);
  EXPECT_EQ(balance.gains, 0U) << told(balance);
}

TEST(Energy, OfASpringComesAndGoes) {
  json document = alone(600);
  document["shapes"].push_back({{"name", "ball"}, {"type", "sphere"}, {"radius", 0.5}});
  document["bodies"] = {
      {{"name", "ball"}, {"shape", "ball"}, {"mass", 1}, {"position", {0, 0, 0}}, {"velocity", {3, 0, 0}}}};
  document["joints"] = {{{"type", "spring"}, {"a", "ball"}, {"pivot", {0, 0, 0}}, {"stiffness", 40}, {"damping", 0}}};
  const EnergyBalance balance = balance_of(document);
  EXPECT_NEAR(balance.first, 4.5, 1e-3);
  EXPECT_NEAR(balance.now, 4.5, 0.2);
  EXPECT_EQ(balance.gains, 0U) << told(balance);
}

/// A body that is taken out takes the energy of its spring along, and draws out none from then on.
TEST(Energy, OfASpringGoesWithTheBodyThatIsTakenOut) {
  json document = alone(120);
  document["world"]["on_leave"] = "remove";
  document["world"]["bounds"] = {{"min", {-5, -5, -5}}, {"max", {1, 5, 5}}};
  document["shapes"].push_back({{"name", "ball"}, {"type", "sphere"}, {"radius", 0.25}});
  document["bodies"] = {
      {{"name", "leaves"}, {"shape", "ball"}, {"mass", 3}, {"position", {0, 0, 0}}, {"velocity", {6, 0, 0}}},
      {{"name", "stays"},
       {"shape", "ball"},
       {"mass", 2},
       {"position", {-3, 0, 0}},
       {"velocity", {-0.5, 0, 0}},
       {"sleep", false}}};
  document["joints"] = {{{"type", "spring"}, {"a", "leaves"}, {"pivot", {0, 0, 0}}, {"stiffness", 70}, {"damping", 0}}};
  const EnergyBalance balance = balance_of(document);
  EXPECT_NEAR(balance.first, 3 * 36 / 2.0 + 2 * 0.25 / 2, 1e-3);
  EXPECT_NEAR(balance.now, 0.25, 1e-4);
  EXPECT_NEAR(balance.work.other, -3 * 36 / 2.0, 0.1) << "motion and spring of what was taken out";
  EXPECT_EQ(balance.gains, 0U) << told(balance);
}

/// A spring that pulls at corners turns the boxes as well.
TEST(Energy, OfASpringBetweenTumblingBoxesStays) {
  json document = alone(45);
  document["shapes"] = {box("one", {0.4, 0.2, 0.1}), box("other", {0.1, 0.3, 0.4})};
  document["bodies"] = {
      {{"name", "one"},
       {"shape", "one"},
       {"mass", 2},
       {"position", {-0.4, -0.2, -0.1}},
       {"spin", {1, 2, -1}},
       {"velocity", {-1, 0.2, 0.4}}},
      {{"name", "other"}, {"shape", "other"}, {"mass", 3}, {"position", {0.1, 0.3, 0.4}}, {"spin", {-2, 0.5, 1}}}};
  document["joints"] = {{{"type", "spring"}, {"a", "one"}, {"b", "other"}, {"pivot", {0, 0, 0}}, {"stiffness", 50}}};
  document["exclusions"] = json::array({json::array({"one", "other"})});
  const EnergyBalance balance = balance_of(document);
  EXPECT_NEAR(balance.now / balance.first, 1, 0.03);
  EXPECT_EQ(balance.gains, 0U) << told(balance);
}

TEST(Energy, IsNotAccountedForWhereNobodyAsks) {
  const scenes::Scene scene = exhibit("contacts");
  Simulation asked(scene, "boxstream"), quiet(scene, "boxstream");
  for (int i = 0; i < scene.time.steps; ++i) {
    quiet.advance();
    ASSERT_EQ(asked.step().state_hash, quiet.state_hash()) << "looking on changes nothing";
  }
  EXPECT_EQ(asked.energy_balance().steps, static_cast<std::uint64_t>(scene.time.steps));
  EXPECT_EQ(quiet.energy_balance().steps, 0U);
  // What happened in between is no gain.
  Simulation mixed(scene, "boxstream");
  mixed.step();
  for (int i = 0; i < 20; ++i) mixed.advance();
  mixed.step();
  EXPECT_EQ(mixed.energy_balance().steps, 2U);
  EXPECT_LT(std::abs(mixed.energy_balance().lost()), 0.1);
}

}  // namespace
}  // namespace boxstream::effects_test
