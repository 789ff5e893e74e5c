// SPDX-License-Identifier: MIT
#include "boxes/changed_boxes.hpp"

#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "boxes/pair_difference.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "simulation/run/pair_check.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::report {
namespace {

std::vector<Pair> held_with(const ChangeOfBox& change, std::vector<Pair>& needed) {
  scenes::Scene scene = scenes::scaled(scenes::load_scene("demos/scenes/broadmark_fall_cubes.json"), 0.3);
  ChangedBoxes* boxes = nullptr;
  scenes::Simulation simulation(scene, "boxstream", [&](std::unique_ptr<btBroadphaseInterface> inner) {
    auto changed = std::make_unique<ChangedBoxes>(std::move(inner), change);
    boxes = changed.get();
    return changed;
  });
  std::vector<Pair> held;
  simulation.set_after_pairs([&] {
    held = scenes::held_pairs(simulation);
    needed = boxes->needed_pairs();
  });
  for (int step = 0; step < 4; ++step) simulation.step();
  return held;
}

TEST(ChangedBoxes, TightOnesMakeExactlyTheNeededPairs) {
  std::vector<Pair> needed;
  const std::vector<Pair> held =
      held_with([](const Aabb& given, const btCollisionObject&) { return tight_box(given); }, needed);
  EXPECT_FALSE(needed.empty());
  EXPECT_EQ(held, needed);
}

TEST(ChangedBoxes, LargerOnesMissNothingAndHaveMore) {
  std::vector<Pair> needed;
  const std::vector<Pair> held = held_with(sphere_box, needed);
  const PairDifference difference = compare_pairs(needed, held);
  EXPECT_EQ(difference.missed, 0u);
  EXPECT_GT(difference.extra, 0u);
}

TEST(ChangedBoxes, BoxesThatLieAreNoticed) {
  std::vector<Pair> needed;
  const auto point = [](const Aabb& given, const btCollisionObject&) {
    return Aabb{{given.min[0], given.min[1], given.min[2]}, {given.min[0], given.min[1], given.min[2]}};
  };
  const std::vector<Pair> held = held_with(point, needed);
  EXPECT_GT(compare_pairs(needed, held).missed, 0u);
}

TEST(SphereBox, ContainsTheShapeHoweverItTurns) {
  btBoxShape shape({1, 2, 3});
  btCollisionObject object;
  object.setCollisionShape(&shape);
  for (int i = 0; i < 50; ++i) {
    btTransform pose(btQuaternion(btVector3(1, 2, btScalar(i)).normalized(), btScalar(i)), {5, 6, 7});
    object.setWorldTransform(pose);
    btVector3 lo, hi;
    shape.getAabb(pose, lo, hi);
    const Aabb given{{lo.x(), lo.y(), lo.z()}, {hi.x(), hi.y(), hi.z()}};
    const Aabb box = sphere_box(given, object);
    for (int d = 0; d < 3; ++d) {
      EXPECT_LE(box.min[d], given.min[d]);
      EXPECT_GE(box.max[d], given.max[d]);
      EXPECT_NEAR(box.max[d] - box.min[d], 2 * (std::sqrt(14.0) + 0.02), 0.2);
    }
  }
}

}  // namespace
}  // namespace boxstream::report
