// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <btBulletDynamicsCommon.h>

#include "gallery.hpp"
#include "simulation/effects/unfit.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

// Chains and robots by the coordinates of their joints, against closed forms.
namespace boxstream::effects_test {
namespace {

using nlohmann::json;
using scenes::Simulation;

constexpr double g = 9.81;

const btRigidBody& body(const Simulation& simulation, std::size_t index) {
  return *btRigidBody::upcast(simulation.objects()[index]);
}
btVector3 place(const Simulation& simulation, std::size_t index) {
  return body(simulation, index).getWorldTransform().getOrigin();
}

json empty_world(const char* kind = "multibodies") {
  json document = document_of("multibodies");
  document.erase("expect");
  document["solver"] = {{"kind", kind}};
  document["bodies"] = json::array();
  document["joints"] = json::array();
  document["shapes"] = {{{"name", "rod"}, {"type", "box"}, {"half_extents", {0.7, 0.05, 0.03}}},
                        {{"name", "ball"}, {"type", "sphere"}, {"radius", 0.1}},
                        {{"name", "brick"}, {"type", "box"}, {"half_extents", {0.1, 0.2, 0.3}}}};
  document["world"]["bounds"] = {{"min", {-100, -100, -100}}, {"max", {100, 100, 100}}};
  return document;
}

json& add_body(json& document, const char* shape, double mass, const std::vector<double>& position) {
  document["bodies"].push_back({{"name", "b" + std::to_string(document["bodies"].size())},
                                {"shape", shape},
                                {"material", "smooth"},
                                {"mass", mass},
                                {"position", position},
                                {"sleep", false}});
  return document["bodies"].back();
}

/// Between a body and one that was added before; -1: the world.
json& add_joint(json& document, const char* type, int a, int b, const std::vector<double>& pivot,
                const std::vector<double>& axis = {}) {
  json joint = {{"type", type}, {"a", "b" + std::to_string(a)}, {"pivot", pivot}};
  if (b >= 0) joint["b"] = "b" + std::to_string(b);
  if (!axis.empty()) joint["axis"] = axis;
  document["joints"].push_back(joint);
  return document["joints"].back();
}

/// Seconds from one passage below the pivot to the next but one, by the sign of x of a body.
double period(Simulation& simulation, std::size_t index) {
  std::vector<double> passed;
  double before = place(simulation, index).x();
  for (int step = 1; passed.size() < 5; ++step) {
    simulation.advance();
    const double now = place(simulation, index).x();
    if ((before < 0) != (now < 0)) passed.push_back((step - now / (now - before)) / 60);
    before = now;
    if (step > 6000) return 0;
  }
  return (passed[4] - passed[0]) / 2;
}

TEST(Multibodies, HoldAChainWithAThousandTimesItsMass) {
  json document = empty_world();
  for (int i = 0; i < 13; ++i) {
    add_body(document, "ball", i == 12 ? 1300 : 1, {0, -0.3 * i, 0});
    add_joint(document, "ball", i, i - 1, {0, -0.3 * i + 0.15, 0});
  }
  // Struck from the side: what hangs on a stiff chain swings a thousand times faster than it does.
  document["bodies"][6]["velocity"] = {0.05, 0, 0};
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 600; ++i) {
    simulation.advance();
    ASSERT_NEAR(place(simulation, 12).y(), -3.6, 2e-3) << i;
  }
}

TEST(Multibodies, SwingAsACompoundPendulum) {
  // A rod of 1.4 m on a hinge at 0.5 m from its middle, by 2 degrees.
  const double arm = 0.5, angle = 2 * SIMD_PI / 180, moment = 3 * (1.4 * 1.4 + 0.1 * 0.1) / 12 + 3 * arm * arm;
  json document = empty_world();
  add_body(document, "rod", 3, {arm * std::sin(angle), -arm * std::cos(angle), 0})["rotation"] = {{"axis", {0, 0, 1}},
                                                                                                  {"degrees", -90 + 2}};
  add_joint(document, "hinge", 0, -1, {0, 0, 0}, {0, 0, 1});
  Simulation simulation(scene_of(document), "boxstream");
  const double small = 2 * SIMD_PI * std::sqrt(moment / (3 * g * arm));
  // The midpoint rule swings slower by (w dt)^2 / 12, 0.02 %.
  EXPECT_NEAR(period(simulation, 0), small * (1 + angle * angle / 16), small * 1e-3);
}

/// Joules; the lowest place that it could come to is 0.
double energy(const Simulation& simulation) {
  return simulation.metric(scenes::Check::Metric::energy);
}

TEST(Multibodies, KeepTheEnergyOfADoublePendulum) {
  // Let go from above the level, so that it tumbles.
  for (const char* const joint : {"hinge", "ball"}) {
    json document = empty_world();
    add_body(document, "ball", 1.5, {0.6, 0.8, 0});
    add_body(document, "ball", 0.5, {1.3, 1.5, 0});
    add_joint(document, joint, 0, -1, {0, 0, 0}, *joint == 'h' ? std::vector<double>{0, 0, 1} : std::vector<double>{});
    add_joint(document, joint, 1, 0, {0.6, 0.8, 0},
              *joint == 'h' ? std::vector<double>{0, 0, 1} : std::vector<double>{});
    Simulation simulation(scene_of(document), "boxstream");
    const double first = energy(simulation), range = g * (1.5 * (0.8 + 1) + 0.5 * (1.5 + 1 + std::sqrt(0.98)));
    double worst = 0;
    for (int i = 0; i < 3600; ++i) {
      simulation.advance();
      worst = std::max(worst, std::abs(energy(simulation) - first));
    }
    EXPECT_LT(worst, 0.05 * range) << joint;
    EXPECT_NEAR(place(simulation, 0).length(), 1, 1e-4) << joint;
    EXPECT_NEAR((place(simulation, 1) - place(simulation, 0)).length(), std::sqrt(0.98), 1e-4) << joint;
  }
}

TEST(Multibodies, AreDrivenByMotorsAsFarAsTheirForceGoes) {
  // 4 kg on rails, whose motor has 6 N: 1.5 m/s^2 up to 3 m/s after 2 s. Once with the world first.
  for (const bool flipped : {false, true}) {
    json document = empty_world();
    add_body(document, "brick", 1e5, {0, -5, 0});
    add_body(document, "brick", 4, {0, 0, 0});
    add_joint(document, "fixed", 0, -1, {0, -5, 0});
    add_joint(document, "slider", flipped ? 0 : 1, flipped ? 1 : 0, {0, 0, 0}, {1, 0, 0})["motor"] = {
        {"speed", flipped ? -3 : 3}, {"max_force", 6}};
    Simulation simulation(scene_of(document), "boxstream");
    for (int i = 0; i < 60; ++i) simulation.step();
    EXPECT_NEAR(body(simulation, 1).getLinearVelocity().x(), 1.5, 1e-3);
    EXPECT_NEAR(place(simulation, 1).x(), 0.75, 1e-3);
    for (int i = 0; i < 120; ++i) simulation.step();
    EXPECT_NEAR(body(simulation, 1).getLinearVelocity().x(), 3, 1e-4);
    EXPECT_NEAR(place(simulation, 1).x(), 6, 1e-2);
    EXPECT_NEAR(simulation.energy_balance().work.motors, 4 * 3 * 3 / 2.0, 0.05);
    EXPECT_EQ(simulation.energy_balance().gains, 0u);
    EXPECT_GT(simulation.solver_rows().acting_motor, 0u);
  }
}

TEST(Multibodies, HoldTheirPoseByMotorsOfSpeedZero) {
  // An arm of three rods, stretched out level: the first motor takes the moment of all.
  json document = empty_world();
  const double torque = 2 * g * (0.7 + 2.1 + 3.5);
  for (int i = 0; i < 3; ++i) {
    add_body(document, "rod", 2, {0.7 + 1.4 * i, 0, 0});
    add_joint(document, "hinge", i, i - 1, {1.4 * i, 0, 0}, {0, 0, 1})["motor"] = {{"speed", 0},
                                                                                   {"max_force", 1.05 * torque}};
  }
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 600; ++i) simulation.advance();
  EXPECT_NEAR(place(simulation, 2).y(), 0, 0.02);
  // With a twentieth less than it takes, it sinks.
  for (json& joint : document["joints"]) joint["motor"]["max_force"] = 0.95 * torque;
  Simulation weak(scene_of(document), "boxstream");
  for (int i = 0; i < 600; ++i) weak.advance();
  EXPECT_LT(place(weak, 2).y(), -1);
}

TEST(Multibodies, StopAtTheLimitsOfTheirJoints) {
  json document = empty_world();
  add_body(document, "rod", 2, {0.7, 0, 0});
  add_joint(document, "hinge", 0, -1, {0, 0, 0}, {0, 0, 1})["limits"] = {-30, 10};
  add_body(document, "brick", 2, {0, 0, 3});
  // The axis points upwards and the world is the first body's other one: it falls by 0.4 m.
  add_joint(document, "slider", 1, -1, {0, 0, 3}, {0, 1, 0})["limits"] = {-0.4, 0.1};
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 300; ++i) simulation.advance();
  EXPECT_NEAR(std::atan2(place(simulation, 0).y(), place(simulation, 0).x()) * 180 / SIMD_PI, -30, 0.2);
  EXPECT_NEAR(place(simulation, 1).y(), -0.4, 2e-3);
  EXPECT_GT(simulation.solver_rows().acting_limit, 0u);
}

class RandomTree {
 public:
  explicit RandomTree(unsigned seed) : random_(seed) {}

  json document(bool in_world) {
    json scene = empty_world();
    const int count = 2 + static_cast<int>(random_() % 7);
    for (int i = 0; i < count; ++i) {
      json& b = add_body(scene, "brick", number(0.5, 5), place());
      b["rotation"] = {{"axis", place()}, {"degrees", number(0, 360)}};
      b["mask"] = 0;
      // Others are moved by their joints alone.
      if (i == 0) b["velocity"] = {number(-1, 1), number(-1, 1), number(-1, 1)};
      if (i == 0) b["spin"] = {number(-1, 1), number(-1, 1), number(-1, 1)};
    }
    for (int i = 1; i < count; ++i) {
      const int other = static_cast<int>(random_() % static_cast<unsigned>(i));
      const bool first = random_() % 2 == 0;
      // Under gravity a slider without ends falls until floats do not tell places apart.
      join(scene, first ? i : other, first ? other : i, !in_world);
    }
    if (in_world) join(scene, static_cast<int>(random_() % static_cast<unsigned>(count)), -1, false);
    return scene;
  }

 private:
  double number(double low, double high) { return low + (high - low) * (random_() / 4294967296.0); }
  std::vector<double> place() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
  void join(json& scene, int a, int b, bool may_slide) {
    constexpr const char* kinds[] = {"hinge", "ball", "fixed", "slider"};
    const char* const kind = kinds[random_() % (may_slide ? 4 : 3)];
    const bool has_axis = *kind == 'h' || *kind == 's';
    add_joint(scene, kind, a, b, place(), has_axis ? place() : std::vector<double>{});
  }

  std::mt19937 random_;
};

/// How far the two places of a joint are apart, across the axis of a slider.
double gap(const Simulation& simulation, const scenes::Joint& joint, const std::vector<btTransform>& at_first) {
  const auto moved = [&](std::optional<std::size_t> index, const btVector3& v) {
    return index ? body(simulation, *index).getWorldTransform() * at_first[*index].invXform(v) : v;
  };
  const scenes::Vec3 pivot = std::visit([](const auto& value) { return value.pivot; }, joint.value);
  const btVector3 point(static_cast<float>(pivot[0]), static_cast<float>(pivot[1]), static_cast<float>(pivot[2]));
  btVector3 apart = moved(joint.a, point) - moved(joint.b, point);
  if (const auto* const slider = std::get_if<scenes::SliderJoint>(&joint.value)) {
    const btVector3 axis(static_cast<float>(slider->axis[0]), static_cast<float>(slider->axis[1]),
                         static_cast<float>(slider->axis[2]));
    const btVector3 now =
        body(simulation, joint.a).getWorldTransform().getBasis() * (axis * at_first[joint.a].getBasis());
    apart -= now * now.dot(apart);
  }
  return apart.length();
}

TEST(Multibodies, LeftToChanceKeepEnergyAndNeverComeApart) {
  double worst = 0;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const bool in_world = seed % 2 == 0;
    json document = RandomTree(seed).document(in_world);
    // Without a hold in the world: without gravity, or all falls out of float's precision.
    if (!in_world) document["world"]["gravity"] = {0, 0, 0};
    const scenes::Scene scene = scene_of(document);
    Simulation simulation(scene, "boxstream");
    ASSERT_EQ(effects::unfit(scene), std::vector<std::string>{}) << seed;
    std::vector<btTransform> at_first;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) at_first.push_back(body(simulation, i).getWorldTransform());
    const double first = energy(simulation);
    double most_kinetic = 1e-3, off = 0;
    for (int i = 0; i < 300; ++i) {
      simulation.advance();
      off = std::max(off, std::abs(energy(simulation) - first));
      double kinetic = energy(simulation);
      for (std::size_t k = 0; k < scene.bodies.size(); ++k)
        kinetic -= in_world ? g * place(simulation, k).y() / body(simulation, k).getInvMass() : 0;
      most_kinetic = std::max(most_kinetic, kinetic);
      for (const scenes::Joint& joint : scene.joints)
        ASSERT_LT(gap(simulation, joint, at_first), 3e-5 * (10 + place(simulation, joint.a).length()))
            << "seed " << seed << ", step " << i;
    }
    worst = std::max(worst, off / most_kinetic);
    EXPECT_LT(off / most_kinetic, 0.08) << seed;
  }
  RecordProperty("worst", std::to_string(worst));
}

TEST(Multibodies, AreEqualToTheBitOnEveryBroadphase) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    json document = RandomTree(seed).document(true);
    for (json& b : document["bodies"]) b.erase("mask");
    add_body(document, "brick", 2, {0, -3, 0});
    const scenes::Scene scene = scene_of(document);
    Simulation a(scene, "boxstream"), b(scene, "dbvt"), again(scene, "boxstream");
    for (int i = 0; i < 60; ++i) {
      a.advance();
      b.advance();
      again.advance();
      ASSERT_EQ(a.state_hash(), again.state_hash()) << seed << ", step " << i;
      ASSERT_EQ(check_pairs(a), "") << seed;
      ASSERT_EQ(check_pairs(b), "") << seed;
    }
  }
}

// What is thrown against a link meets it, and what lies on the floor lies there.
TEST(Multibodies, TouchWhatIsAroundThem) {
  json document = empty_world();
  document["shapes"].push_back({{"name", "ground"}, {"type", "box"}, {"half_extents", {20, 1, 20}}});
  document["materials"]["smooth"]["friction"] = 0.7;
  add_body(document, "brick", 2, {0, 0.11, 0})["rotation"] = {{"axis", {0, 0, 1}}, {"degrees", 90}};
  add_body(document, "brick", 2, {0.5, 0.11, 0})["rotation"] = {{"axis", {0, 0, 1}}, {"degrees", 90}};
  add_joint(document, "ball", 0, 1, {0.25, 0.11, 0});
  document["bodies"].push_back(
      {{"name", "ground"}, {"shape", "ground"}, {"type", "static"}, {"material", "smooth"}, {"position", {0, -1, 0}}});
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 300; ++i) simulation.step();
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_NEAR(place(simulation, i).y(), 0.1, 5e-3);
    EXPECT_LT(body(simulation, i).getLinearVelocity().length(), 0.02);
  }
  EXPECT_EQ(simulation.energy_balance().gains, 0u);
}

// A fifth of the angle between links: their bodies would touch if they could.
TEST(Multibodies, TouchWhatTheyAreJoinedToIfTheJointSaysSo) {
  for (const bool collide : {false, true}) {
    json document = empty_world();
    document["world"]["gravity"] = {0, 0, 0};
    add_body(document, "rod", 1, {0.7, 0, 0});
    add_body(document, "rod", 1, {-0.72, 0, 0})["spin"] = {0, 0, -10};
    add_joint(document, "hinge", 0, -1, {0, 0, 0}, {0, 0, 1});
    add_joint(document, "hinge", 1, 0, {0, 0, 0}, {0, 0, 1})["collide"] = collide;
    Simulation simulation(scene_of(document), "boxstream");
    bool through = false;
    for (int i = 0; i < 240; ++i) {
      simulation.advance();
      through = through || (place(simulation, 1) - place(simulation, 0)).length() < 0.05;
    }
    EXPECT_EQ(through, !collide);
  }
}

// A strike at the end of a rod on a hinge turns it by the moment about the hinge.
TEST(Multibodies, TakeKicksAndFieldsThroughTheirBodies) {
  json document = empty_world();
  document["world"]["gravity"] = {0, 0, 0};
  add_body(document, "rod", 3, {0.7, 0, 0});
  add_joint(document, "hinge", 0, -1, {0, 0, 0}, {0, 0, 1});
  Simulation simulation(scene_of(document), "boxstream");
  simulation.advance();
  auto& rod = const_cast<btRigidBody&>(body(simulation, 0));
  rod.applyImpulse(btVector3(0, 2, 0), btVector3(0.7F, 0, 0));
  simulation.advance();
  const double moment = 3 * (1.4 * 1.4 + 0.1 * 0.1) / 12 + 3 * 0.7 * 0.7;
  EXPECT_NEAR(body(simulation, 0).getAngularVelocity().z(), 2 * 1.4 / moment, 1e-3);
  EXPECT_NEAR(body(simulation, 0).getLinearVelocity().length(), 0.7 * 2 * 1.4 / moment, 1e-3);
}

TEST(Multibodies, AreSlowedDownByTheDampingOfTheirBodies) {
  json document = empty_world();
  document["world"]["gravity"] = {0, 0, 0};
  json& brick = add_body(document, "brick", 3, {0, 0, 0});
  brick["velocity"] = {1, 0, 0};
  brick["linear_damping"] = 0.3;
  add_joint(document, "slider", 0, -1, {0, 0, 0}, {1, 0, 0});
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 120; ++i) simulation.advance();
  EXPECT_NEAR(body(simulation, 0).getLinearVelocity().x(), 0.7 * 0.7, 1e-3);
}

TEST(Multibodies, FallAsleepAndAreWokenUp) {
  json document = empty_world();
  document["time"]["steps"] = 600;
  add_body(document, "rod", 3, {0, -0.7, 0})["rotation"] = {{"axis", {0, 0, 1}}, {"degrees", 90}};
  document["bodies"][0].erase("sleep");
  add_joint(document, "hinge", 0, -1, {0, 0, 0}, {0, 0, 1});
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 200; ++i) simulation.advance();
  EXPECT_FALSE(body(simulation, 0).isActive());
  auto& rod = const_cast<btRigidBody&>(body(simulation, 0));
  rod.setLinearVelocity(btVector3(0.7F, 0, 0));
  rod.setAngularVelocity(btVector3(0, 0, 1));
  rod.activate();
  simulation.advance();
  EXPECT_TRUE(body(simulation, 0).isActive());
  EXPECT_NEAR(body(simulation, 0).getAngularVelocity().z(), 1, 0.02);
}

// Four bars: what closes the loop holds as well as the solver does.
TEST(Multibodies, CloseLoopsByBallsAndHinges) {
  for (const char* const kind : {"ball", "hinge"}) {
    json document = empty_world();
    const std::vector<double> axis = *kind == 'h' ? std::vector<double>{0, 0, 1} : std::vector<double>{};
    add_body(document, "brick", 1, {-1, -0.5, 0});
    add_body(document, "brick", 1, {0, -1, 0});
    add_body(document, "brick", 1, {1, -0.5, 0});
    add_joint(document, kind, 0, -1, {-1, 0, 0}, axis);
    add_joint(document, kind, 1, 0, {-1, -1, 0}, axis);
    add_joint(document, kind, 2, 1, {1, -1, 0}, axis);
    add_joint(document, kind, 2, -1, {1, 0, 0}, axis);
    document["bodies"][1]["velocity"] = {1, 0, 0};
    for (json& b : document["bodies"]) b["mask"] = 0;
    const scenes::Scene scene = scene_of(document);
    Simulation simulation(scene, "boxstream");
    std::vector<btTransform> at_first;
    for (std::size_t i = 0; i < 3; ++i) at_first.push_back(body(simulation, i).getWorldTransform());
    double far = 0;
    for (int i = 0; i < 300; ++i) {
      simulation.advance();
      for (const scenes::Joint& joint : scene.joints)
        ASSERT_LT(gap(simulation, joint, at_first), 0.02) << kind << ", step " << i;
      far = std::max(far, std::abs(double{place(simulation, 1).x()}));
    }
    EXPECT_GT(far, 0.1) << "it swings";
  }
}

std::string lines_of(const json& document) {
  std::string all;
  for (const std::string& line : effects::unfit(scene_of(document))) all += line + "\n";
  return all;
}

TEST(Multibodies, SayWhatTheyDoNotDo) {
  const auto has = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  json document = empty_world();
  EXPECT_TRUE(has(lines_of(document), "there are no joints"));
  add_body(document, "brick", 1, {0, 0, 0});
  add_body(document, "brick", 1, {1, 0, 0});
  add_joint(document, "ball", 0, 1, {0.5, 0, 0});
  EXPECT_EQ(lines_of(document), "");
  document["bodies"][1]["ccd"] = {{"threshold", 0.1}, {"radius", 0.05}};
  EXPECT_TRUE(has(lines_of(document), "body 1 (\"b1\") is of a multibody, which is not swept"));
  document["bodies"][1].erase("ccd");
  document["bodies"][0]["gyro"] = false;
  EXPECT_TRUE(has(lines_of(document), "body 0 (\"b0\")"));
  document["bodies"][0].erase("gyro");
  json spring = document;
  spring["joints"].push_back(
      {{"type", "spring"}, {"a", "b1"}, {"pivot", {1, 0, 0}}, {"stiffness", 10}, {"damping", 0}});
  EXPECT_TRUE(has(lines_of(spring), "joint 1 (/joints/1) is a spring")) << lines_of(spring);
  {
    Simulation simulation(scene_of(spring), "boxstream");
    for (int i = 0; i < 60; ++i) simulation.advance();
    EXPECT_EQ(simulation.solver_rows().links, 0u);
    EXPECT_NEAR((place(simulation, 0) - place(simulation, 1)).length(), 1, 0.05) << "both joints are there";
  }
  document["solver"]["bounces"] = "on_contact";
  EXPECT_TRUE(has(lines_of(document), "no joint is of a multibody, because bodies bounce on contact"));
}

TEST(Multibodies, RefuseWhatIsTooLightOrTooHeavyByName) {
  const auto error = [](const json& document) -> std::string {
    try {
      Simulation simulation(scene_of(document), "boxstream");
    } catch (const std::exception& e) {
      return e.what();
    }
    return {};
  };
  json document = empty_world();
  add_body(document, "brick", 1e-6, {0, 0, 0});
  add_joint(document, "hinge", 0, -1, {0, 0, 0}, {0, 0, 1});
  EXPECT_NE(error(document).find("body 0 turns on its hinge with less than"), std::string::npos) << error(document);
  document["bodies"][0]["mass"] = 1e7;
  EXPECT_NE(error(document).find("body 0 has more than 4000 t"), std::string::npos) << error(document);
}

}  // namespace
}  // namespace boxstream::effects_test
