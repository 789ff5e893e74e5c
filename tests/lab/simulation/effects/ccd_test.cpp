// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

// Bodies that become fast in all the ways in which they can, and what is thin and in their way.
namespace boxstream::effects_test {
namespace {

using nlohmann::json;
using scenes::Simulation;

json ball(double radius) {
  return {{"name", "ball"}, {"type", "sphere"}, {"radius", radius}};
}
json box(const char* name, const json& half_extents) {
  return {{"name", name}, {"type", "box"}, {"half_extents", half_extents}};
}
json body(const char* shape, const json& position, const json& velocity = {0, 0, 0}, double mass = 1) {
  return {{"name", shape}, {"shape", shape}, {"mass", mass}, {"position", position}, {"velocity", velocity}};
}
json placed(const char* shape, const json& position, const char* type = "static") {
  return {{"name", shape}, {"shape", shape}, {"type", type}, {"position", position}};
}

/// A world without gravity.
json world_of(const std::vector<json>& shapes, const std::vector<json>& bodies) {
  json document = document_of("nothing");
  document["shapes"] = shapes;
  document["bodies"] = bodies;
  document["world"]["bounds"] = {{"min", {-200, -200, -200}}, {"max", {200, 200, 200}}};
  document["world"].erase("ccd");
  document.erase("expect");
  return document;
}

/// A thin wall, a step in front of what becomes fast.
const json wall = box("wall", {0.01, 2, 2});
const json wall_at = placed("wall", {0.25, 0, 0});

btVector3 place(const Simulation& simulation, std::size_t index = 0) {
  return simulation.objects()[index]->getWorldTransform().getOrigin();
}

struct End {
  btVector3 place;  // of the first body
  std::vector<effects::SwitchedOn> switched_on;
};

End end_of(const json& document, int steps) {
  Simulation simulation(scene_of(document), "boxstream");
  for (int i = 0; i < steps; ++i) simulation.advance();
  return {place(simulation), simulation.switched_on()};
}

/// `document`, in which nothing is swept.
json unswept(json document) {
  document["world"]["ccd"] = false;
  return document;
}

// Bullet leaves out what it would be less than 4 cm deep in: all of a wall, for a body of millimetres.
TEST(Ccd, StopsSmallBodiesThatMoveByLessThanFourCentimetresInAStep) {
  for (const double radius : {0.001, 0.003, 0.011})
    for (const double speed : {1.1, 1.7, 2.2})
      for (const double thickness : {0.003, 0.008})
        for (const double start : {-0.1, -0.107, -0.113}) {
          const json document = world_of({ball(radius), box("wall", {thickness / 2, 1, 1})},
                                         {body("ball", {start, 0, 0}, {speed, 0, 0}, 0.02), placed("wall", {0, 0, 0})});
          EXPECT_LT(end_of(document, 30).place.x(), 0)
              << radius << " m at " << speed << " m/s, " << thickness << ", " << start;
        }
}

TEST(CcdOnDemand, StopsWhatAMotorThrows) {
  json document = world_of({ball(0.05), wall}, {body("ball", {0, 0, 0}), wall_at});
  document["joints"] = {{{"type", "slider"},
                         {"a", "ball"},
                         {"axis", {1, 0, 0}},
                         {"pivot", {0, 0, 0}},
                         {"motor", {{"speed", 30}, {"max_force", 1e6}}}}};
  EXPECT_GT(end_of(unswept(document), 10).place.x(), 2);
  const End end = end_of(document, 10);
  EXPECT_LT(end.place.x(), 0.25);
  EXPECT_EQ(end.switched_on.size(), 1u);
}

TEST(CcdOnDemand, StopsWhatAnotherBodyHits) {
  json document =
      world_of({ball(0.05), {{"name", "hammer"}, {"type", "sphere"}, {"radius", 0.5}}, wall},
               {body("ball", {0, 0, 0}, {0, 0, 0}, 0.01), body("hammer", {-2, 0, 0}, {20, 0, 0}, 1000), wall_at});
  document["materials"]["elastic"] = {{"friction", 0}, {"restitution", 1}};
  document["bodies"][0]["material"] = document["bodies"][1]["material"] = "elastic";
  EXPECT_GT(end_of(unswept(document), 20).place.x(), 2);
  // Before the hammer is there itself, and crushes it on the wall.
  EXPECT_LT(end_of(document, 6).place.x(), 0.25);
  EXPECT_GT(end_of(unswept(document), 6).place.x(), 0.3);
}

TEST(CcdOnDemand, StopsWhatIsPushedOutOfAnOverlap) {
  json document = world_of({ball(0.05), box("block", {3, 6, 6}), wall},
                           {body("ball", {0.5, 0, 0}), placed("block", {0, 0, 0}), placed("wall", {3.3, 0, 0})});
  document["solver"]["split_impulse"] = false;
  EXPECT_GT(end_of(unswept(document), 60).place.x(), 4);
  EXPECT_LT(end_of(document, 60).place.x(), 3.3);
}

TEST(CcdOnDemand, SeesALiftThatHasLeftTheStart) {
  for (const double speed : {20, 24, 27, 30, 33, 40}) {
    json document = world_of({ball(0.1), box("lift", {4, 0.02, 4})},
                             {body("ball", {0, 0.5, 0}), placed("lift", {0, 0, 0}, "kinematic")});
    document["bodies"][1]["velocity"] = {0, -speed, 0};
    document["world"]["gravity"] = {0, -9.81, 0};
    Simulation simulation(scene_of(document), "boxstream");
    for (int i = 0; i < 600; ++i) simulation.advance();
    EXPECT_GT(place(simulation).y(), place(simulation, 1).y() - 0.1) << speed;
  }
}

TEST(CcdOnDemand, LeavesAloneWhatFallsTogether) {
  json document = world_of({ball(0.1), box("floor", {1, 0.1, 1})},
                           {body("ball", {9, 0.5, 0}), body("ball", {9, 0.8, 0}), placed("floor", {0, 0, 0})});
  document["bodies"][1]["name"] = "other";
  document["world"]["gravity"] = {0, -9.81, 0};
  const End end = end_of(document, 600);
  EXPECT_LT(end.place.y(), -400);
  EXPECT_TRUE(end.switched_on.empty());
}

TEST(Ccd, SweepsASheetThatIsAlmostFlat) {
  json points = json::array();
  for (const double x : {-2.0, 2.0})
    for (const double y : {-2e-4, 2e-4})
      for (const double z : {-2.0, 2.0}) points.push_back({x, y, z});
  json document = world_of({{{"name", "sheet"}, {"type", "hull"}, {"points", points}}, box("floor", {5, 0.01, 5})},
                           {body("sheet", {0, 20, 0}), placed("floor", {0, 0, 0})});
  document["world"]["gravity"] = {0, -9.81, 0};
  EXPECT_LT(end_of(unswept(document), 150).place.y(), -1);
  EXPECT_GT(end_of(document, 150).place.y(), -0.01);
}

TEST(Ccd, KnowsAPlateThatIsTurnedForThin) {
  // A plate of 2 cm, in coordinates turned by 45 degrees about z.
  json points = json::array();
  const double root = std::sqrt(0.5);
  for (const double x : {-2.0, 2.0})
    for (const double y : {-0.01, 0.01})
      for (const double z : {-2.0, 2.0}) points.push_back({root * (x - y), root * (x + y), z});
  json plate = placed("plate", {0, 0, 0});
  plate["rotation"] = {{"axis", {0, 0, 1}}, {"degrees", -45}};
  json document = world_of({ball(0.05), {{"name", "plate"}, {"type", "hull"}, {"points", points}}},
                           {body("ball", {0, 20, 0}), plate});
  document["world"]["gravity"] = {0, -9.81, 0};
  EXPECT_LT(end_of(unswept(document), 240).place.y(), -5);
  const End end = end_of(document, 240);
  EXPECT_GT(end.place.y(), 0);
  EXPECT_EQ(end.switched_on.size(), 1u);
}

json with_gate(json document) {
  document["sensors"] = json::array({{{"name", "gate"}, {"half_extents", {0.05, 1, 1}}, {"position", {0.8, 0, 0}}}});
  return document;
}

std::size_t events_of(const json& document) {
  Simulation simulation(scene_of(document), "boxstream");
  std::size_t events = 0;
  for (int i = 0; i < 20; ++i) events += simulation.step().sensor_events.size();
  return events;
}

TEST(Ccd, LetsASensorNoticeWhatIsFast) {
  const json document = with_gate(world_of({ball(0.25)}, {body("ball", {-5.1, 0, 0}, {100, 0, 0})}));
  EXPECT_EQ(events_of(unswept(document)), 0u);
  EXPECT_EQ(events_of(document), 2u) << "in and out";
}

TEST(CcdOnDemand, WaitsForWhatASensorCanNotice) {
  json document = with_gate(world_of({ball(0.25)}, {body("ball", {0, 0, 0})}));
  document["fields"] = json::array({{{"type", "impulses"}, {"share", 1}, {"speed", 100}}});
  EXPECT_EQ(on(effects::plan(scene_of(document))).count("ccd_on_demand"), 1u);
  document["bodies"][0]["mask"] = 1;
  EXPECT_EQ(on(effects::plan(scene_of(document))).count("ccd_on_demand"), 0u) << "the sensor does not see it";
}

TEST(Ccd, IsNotCalledForByABodyThatCanHitNothing) {
  json document = world_of({ball(0.25), box("floor", {1, 0.1, 1})}, {body("ball", {0, 3, 0})});
  document["bodies"][0]["ccd"] = {{"threshold", 0.1}, {"radius", 0.1}};
  EXPECT_EQ(on(effects::plan(scene_of(document))).count("ccd"), 0u);
  document["bodies"].push_back(placed("floor", {0, 0, 0}));
  EXPECT_EQ(on(effects::plan(scene_of(document))).count("ccd"), 1u);
}

TEST(CcdOnDemand, IsToldOfAmongTheEffectsAndInTheirActivity) {
  Simulation simulation(exhibit("ccd_on_demand"), "boxstream");
  for (int i = 0; i < simulation.scene().time.steps; ++i) simulation.step();
  Names names;
  for (const effects::Effect* const effect : simulation.effects_on()) names.insert(effect->name);
  EXPECT_EQ(names, (Names{"gravity", "contacts", "split_impulse", "ccd", "ccd_on_demand"}));
  std::uint64_t hits = 0;
  for (const scenes::EffectActivity& each : simulation.activity())
    if (each.effect->name == std::string("ccd")) hits = each.count;
  EXPECT_GT(hits, 0u);
}

}  // namespace
}  // namespace boxstream::effects_test
