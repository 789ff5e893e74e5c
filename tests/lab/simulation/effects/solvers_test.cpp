// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_model/names.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

// Other solvers than Bullet's usual one, and bounces at the moment of contact, against closed forms.
namespace boxstream::effects_test {
namespace {

using nlohmann::json;
using scenes::Simulation;

const btRigidBody& body(const Simulation& simulation, std::size_t index) {
  return *btRigidBody::upcast(simulation.objects()[index]);
}
btVector3 place(const Simulation& simulation, std::size_t index) {
  return body(simulation, index).getWorldTransform().getOrigin();
}

json empty_world(const char* kind) {
  json document = document_of("contacts");
  document.erase("expect");
  document["solver"] = {{"kind", kind}};
  return document;
}

/// 20 links of 1 kg with a ball of `load` kg at the end.
json chain(const char* kind, double load) {
  json document = empty_world(kind);
  document["bodies"] = json::array();
  document["shapes"] = {{{"name", "link"}, {"type", "capsule"}, {"radius", 0.1}, {"height", 0.2}},
                        {{"name", "end"}, {"type", "sphere"}, {"radius", 0.5}}};
  document["generators"] = {{{"type", "chain"},
                             {"links", 20},
                             {"anchor", {0, 0, 0}},
                             {"direction", {0, -1, 0}},
                             {"pitch", 0.5},
                             {"end_offset", 0.5},
                             {"link", {{"shape", "link"}, {"mass", 1}, {"sleep", false}}},
                             {"end", {{"shape", "end"}, {"mass", load}, {"sleep", false}}}}};
  document["world"]["bounds"] = {{"min", {-30, -30, -30}}, {"max", {30, 30, 30}}};
  return document;
}

double end_of_chain(const char* kind, double load) {
  Simulation simulation(scene_of(chain(kind, load)), "boxstream");
  for (int i = 0; i < 600; ++i) simulation.advance();
  EXPECT_EQ(simulation.solver_rows().handed_back, 0u) << kind;
  return place(simulation, 20).y();
}

TEST(Solvers, DantzigHoldsAChainWithAThousandTimesItsMassWithoutSubsteps) {
  EXPECT_LT(end_of_chain("sequential_impulses", 1000), -11.5);
  EXPECT_NEAR(end_of_chain("dantzig", 1000), -10.5, 1e-3);
}

TEST(Solvers, ComputeWithThePrecisionOfThisProgram) {
  json document = empty_world("sequential_impulses");
  document["solver"]["precision"] = "single";
  EXPECT_NO_THROW(Simulation(scene_of(document), "boxstream"));
  document["solver"]["precision"] = "double";
  EXPECT_THROW(Simulation(scene_of(document), "boxstream"), scenes::SceneError);
}

/// A cube on a slope: friction 0.5 holds up to 26.6 degrees. Its way in two seconds.
double way_on_slope(const std::string& kind, double degrees) {
  json document = empty_world(kind.c_str());
  const double a = degrees * SIMD_PI / 180;
  document["world"]["gravity"] = {9.81 * std::sin(a), -9.81 * std::cos(a), 0};
  document["materials"]["smooth"] = {{"friction", std::sqrt(0.5)}};
  document["shapes"][0] = {{"name", "ball"}, {"type", "box"}, {"half_extents", {0.5, 0.5, 0.5}}};
  document["bodies"][0]["velocity"] = {0, 0, 0};
  document["bodies"][0]["sleep"] = false;
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 120; ++i) simulation.advance();
  // Dantzig's and Lemke's methods fail now and then: sequential impulses take over.
  EXPECT_LE(simulation.solver_rows().handed_back, kind == "dantzig" || kind == "lemke" ? 3u : 0u) << kind;
  EXPECT_EQ(simulation.solver_rows().other > 0, kind != "sequential_impulses" && kind != "multibodies");
  return place(simulation, 0).x();
}

TEST(Solvers, AllHoldAndLetSlideByFriction) {
  for (const std::string& kind : scenes::solver_names()) {
    EXPECT_NEAR(way_on_slope(kind, 25), 0, 0.02) << kind;
    const double a = 35 * SIMD_PI / 180, way = 9.81 * (std::sin(a) - 0.5 * std::cos(a)) * 2;
    EXPECT_NEAR(way_on_slope(kind, 35), way, 0.03 * way) << kind;
  }
}

/// How deep bodies of a pyramid are in each other, and how fast they are, after two seconds in which it has settled.
std::pair<double, double> unrest_of_pyramid(const char* directions, int iterations) {
  json document = empty_world("sequential_impulses");
  document["solver"]["friction_directions"] = directions;
  document["solver"]["iterations"] = iterations;
  document["shapes"][0] = {{"name", "brick"}, {"type", "box"}, {"half_extents", {0.5, 0.5, 0.5}}};
  document["materials"]["smooth"] = {{"friction", 0.7}};
  document["bodies"].erase(0);
  document["generators"] = {{{"type", "pyramid"},
                             {"levels", 10},
                             {"gap", 0.1},
                             {"origin", {0, 0, 0}},
                             {"brick", {{"shape", "brick"}, {"material", "smooth"}, {"mass", 1}, {"sleep", false}}}}};
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 120; ++i) simulation.advance();
  using Metric = scenes::Check::Metric;
  return {simulation.metric(Metric::max_penetration), simulation.metric(Metric::max_speed)};
}

TEST(Solvers, LeaveContactsOfTwoDirectionsOfFrictionAsQuietAsThoseOfOne) {
  const auto one = unrest_of_pyramid("one", 10), two = unrest_of_pyramid("two", 10);
  EXPECT_LT(two.first, one.first);
  EXPECT_LT(two.second, 0.01);
}

/// The speed of a ball of 1 m/s after two seconds on a floor of rolling friction.
double rolling_speed(const std::string& kind) {
  json document = document_of("rolling_friction");
  document.erase("expect");
  document["solver"]["kind"] = kind;
  Simulation simulation(scene_of(document), "boxstream");
  const double first = body(simulation, 0).getLinearVelocity().length();
  for (int i = 0; i < 60; ++i) simulation.advance();
  EXPECT_GT(simulation.solver_rows().acting_rolling, 0u) << kind;
  return body(simulation, 0).getLinearVelocity().length() / first;
}

TEST(Solvers, OfMatricesHaveRowsOfRollingFriction) {
  const double usual = rolling_speed("sequential_impulses");
  EXPECT_LT(usual, 0.95);
  for (const char* const kind : {"dantzig", "lemke", "projected_gauss_seidel"})
    EXPECT_NEAR(rolling_speed(kind), usual, 0.05) << kind;
}

// The rows of a ring of four fixed joints say the same more than once.
TEST(Solvers, OfMatricesTakeLoopsOfJoints) {
  json document = empty_world("dantzig");
  document["world"]["gravity"] = {0, -9.81, 0};
  document["bodies"] = json::array();
  const double places[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  document["joints"] = json::array({{{"type", "fixed"}, {"a", "b0"}, {"pivot", {-1, -1, 0}}}});
  for (int i = 0; i < 4; ++i) {
    const std::string name = "b" + std::to_string(i), next = "b" + std::to_string((i + 1) % 4);
    document["bodies"].push_back({{"name", name},
                                  {"shape", "ball"},
                                  {"material", "smooth"},
                                  {"mass", 1},
                                  {"position", {places[i][0], places[i][1], 0}},
                                  {"sleep", false}});
    document["joints"].push_back({{"type", "fixed"}, {"a", name}, {"b", next}, {"pivot", {0, 0, 0}}});
  }
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 120; ++i) simulation.advance();
  EXPECT_NEAR(place(simulation, 2).y(), 1, 0.02);
  EXPECT_NEAR(place(simulation, 2).x(), 1, 0.02);
}

TEST(Solvers, OfMatricesLeaveLargeIslandsToSequentialImpulses) {
  json document = empty_world("dantzig");
  document["bodies"].erase(0);
  document["shapes"][0] = {{"name", "ball"}, {"type", "box"}, {"half_extents", {0.5, 0.5, 0.5}}};
  document["materials"]["smooth"] = {{"friction", 0.5}};
  for (int i = 0; i < 60; ++i)
    document["bodies"].push_back({{"name", "b" + std::to_string(i)},
                                  {"shape", "ball"},
                                  {"material", "smooth"},
                                  {"mass", 1},
                                  {"position", {0.98 * (i % 10) - 4.4, 0.5 + 0.99 * (i / 10), 0}}});
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 5; ++i) simulation.advance();
  EXPECT_GT(simulation.solver_rows().handed_back, 0u);
  EXPECT_TRUE(simulation.is_finite());
}

/// Heights of the first bounces of a ball that is dropped by 1 m.
std::vector<double> heights(double restitution, int substeps, int steps) {
  json document = document_of("bounces_on_contact");
  document.erase("expect");
  document["time"]["substeps"] = substeps;
  document["materials"]["rubber"]["restitution"] = std::sqrt(restitution);
  document["bodies"][0]["position"] = {0, 1.5, 0};
  document["bodies"][0]["velocity"] = {0, 0, 0};
  document["bodies"][0]["sleep"] = false;
  Simulation simulation(scene_of(document), "boxstream");
  std::vector<double> found, last{0, 0, 0};
  for (int i = 0; i < steps; ++i) {
    simulation.advance();
    last = {last[1], last[2], place(simulation, 0).y() - 0.5};
    if (i > 2 && last[1] > last[0] && last[1] >= last[2]) found.push_back(last[1]);
  }
  return found;
}

TEST(BouncesOnContact, KeepWhatTheRestitutionSays) {
  for (const double e : {0.3, 0.5, 0.8, 1.0}) {
    const std::vector<double> found = heights(e, 1, 600);
    ASSERT_GE(found.size(), 2u) << e;
    // The highest place of a step is up to g dt^2 / 8 below that of the parabola.
    EXPECT_NEAR(found[0], e * e, 0.002) << e;
    EXPECT_NEAR(found[1], e * e * e * e, 0.003) << e;
  }
  EXPECT_NEAR(heights(1, 1, 2000).back(), 1, 0.02) << "after twenty bounces and more";
  EXPECT_LT(heights(0.5, 1, 1200).back(), 0.01) << "it comes to rest";
}

/// Five balls in a row, of which the first hits the others with 2 m/s: their speeds.
std::vector<double> row_of_balls(const char* bounces) {
  json document = document_of("bounces_on_contact");
  document.erase("expect");
  document["solver"]["bounces"] = bounces;
  document["world"]["gravity"] = {0, 0, 0};
  document["materials"]["rubber"]["restitution"] = 1;
  json ball = document["bodies"][0];
  document["bodies"] = json::array();
  for (int i = 0; i < 5; ++i) {
    ball["name"] = "b" + std::to_string(i);
    ball["position"] = {i == 0 ? -0.51 : static_cast<double>(i), 0, 0};
    ball["velocity"] = {i == 0 ? 2 : 0, 0, 0};
    document["bodies"].push_back(ball);
  }
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < 60; ++i) simulation.advance();
  std::vector<double> speeds;
  for (std::size_t i = 0; i < 5; ++i) speeds.push_back(body(simulation, i).getLinearVelocity().x());
  return speeds;
}

TEST(BouncesOnContact, PassThroughARowToItsLastBall) {
  const std::vector<double> on_contact = row_of_balls("on_contact"), in_solver = row_of_balls("in_solver");
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(on_contact[i], i == 4 ? 2 : 0, 1e-4) << i;
  EXPECT_LT(in_solver[4], 1.9);
}

}  // namespace
}  // namespace boxstream::effects_test
