// SPDX-License-Identifier: MIT

#include <gtest/gtest.h>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_json/load_scene.hpp"
#include "mixed.hpp"
#include "pictures/viewer/names.hpp"
#include "pictures/viewer/snapshot.hpp"

namespace boxstream::view {
namespace {

/// A joint of every kind, between two bodies and to the world, and a vehicle.
const char* const scene_text = R"({
  "format": 1,
  "meta": {"name": "joints", "about": "Joints.", "source": "made for boxstream, MIT", "tags": ["test"]},
  "time": {"dt": 0.01, "steps": 10},
  "world": {"gravity": [0, -9.81, 0], "bounds": {"min": [-50, -50, -50], "max": [50, 50, 50]}, "seed": 1},
  "shapes": [{"name": "block", "type": "box", "half_extents": [0.5, 0.4, 0.3]}],
  "bodies": [
    {"name": "one", "shape": "block", "mass": 1, "position": [1, 2, 3], "rotation": {"axis": [0, 0, 1], "degrees": 30}},
    {"name": "two", "shape": "block", "mass": 1, "position": [4, 2, 3], "rotation": {"axis": [0, 1, 0], "degrees": 70}},
    {"shape": "block", "mass": 800, "position": [0, 9, 0]}
  ],
  "joints": [
    {"type": "ball", "a": "one", "b": "two", "pivot": [2, 2, 3]},
    {"type": "hinge", "a": "one", "b": "two", "pivot": [2, 2, 3], "axis": [0, 1, 0]},
    {"type": "slider", "a": "one", "b": "two", "pivot": [2, 2, 3], "axis": [1, 0, 0]},
    {"type": "cone_twist", "a": "one", "b": "two", "pivot": [2, 2, 3], "axis": [1, 0, 0], "swing1": 0.5, "swing2": 0.5, "twist": 0.5},
    {"type": "fixed", "a": "one", "b": "two", "pivot": [2, 2, 3]},
    {"type": "6dof", "a": "one", "b": "two", "pivot": [2, 2, 3]},
    {"type": "spring", "a": "one", "b": "two", "pivot": [2, 2, 3], "stiffness": 10, "damping": 1},
    {"type": "ball", "a": "one", "pivot": [2, 2, 3]},
    {"type": "slider", "a": "one", "pivot": [2, 2, 3], "axis": [1, 0, 0]}
  ]
})";

TEST(Links, EveryKindOfJointHasItsPivotInBothBodies) {
  scenes::Simulation simulation(scenes::parse_scene(scene_text, "joints"), "boxstream");
  const std::vector<Link> links = links_of(simulation, keep_all(simulation));
  ASSERT_EQ(links.size(), 9U);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const auto in_world = [&](std::int32_t body, const Point& p) {
      const btVector3 local(p[0], p[1], p[2]);
      return body < 0 ? local : simulation.objects()[static_cast<std::size_t>(body)]->getWorldTransform() * local;
    };
    EXPECT_LE(in_world(links[i].a, links[i].pivot_in_a).distance(btVector3(2, 2, 3)), 1e-5F) << "joint " << i;
    EXPECT_LE(in_world(links[i].b, links[i].pivot_in_b).distance(btVector3(2, 2, 3)), 1e-5F) << "joint " << i;
    EXPECT_GE(links[i].a, 0);
    EXPECT_EQ(links[i].b < 0, i >= 7) << "joint " << i;
  }
}

TEST(Links, ThingsAreNamedByTheSceneOrByTheirShape) {
  const scenes::Simulation simulation(scenes::parse_scene(scene_text, "joints"), "boxstream");
  EXPECT_EQ(names_of(simulation, keep_all(simulation)), (std::vector<std::string>{"one", "two", "block"}));
  EXPECT_EQ(names_of(simulation, {{0, 2}, 3}), (std::vector<std::string>{"one", "block"}));
  const scenes::Simulation mixed(view_test::mixed_scene(), "boxstream");
  EXPECT_EQ(names_of(mixed, keep_all(mixed)).size(), mixed.objects().size());
}

TEST(Links, JointsOfWhatIsNotKeptAreLeftOut) {
  scenes::Simulation simulation(scenes::parse_scene(scene_text, "joints"), "boxstream");
  const std::vector<Link> links = links_of(simulation, {{1}, 3});
  EXPECT_TRUE(std::all_of(links.begin(), links.end(), [](const Link& link) { return link.a == 0 && link.b < 0; }));
  EXPECT_LT(links.size(), 9U);
}

TEST(Links, WheelsFollowTheObjects) {
  const scenes::Scene scene = scenes::load_scene(scenes::shipped("effects/vehicles.json"));
  scenes::Simulation simulation(scene, "boxstream");
  const Model model = model_of(simulation);
  ASSERT_GT(model.wheels, 0U);
  ASSERT_EQ(model.states.size(), simulation.objects().size() + model.wheels);
  Snapshot snapshot;
  for (int i = 0; i < 30; ++i) simulation.step();
  snapshot.read(simulation, model);
  for (std::size_t wheel = simulation.objects().size(); wheel < model.states.size(); ++wheel) {
    EXPECT_EQ(snapshot.moods[wheel], Mood::wheel);
    EXPECT_GT(snapshot.boxes[wheel].min[0], snapshot.boxes[wheel].max[0]) << "a ray has no box";
    EXPECT_GT(snapshot.poses[wheel].position[1], 0);
  }
}

}  // namespace
}  // namespace boxstream::view
