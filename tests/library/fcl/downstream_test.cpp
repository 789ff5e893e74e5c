// SPDX-License-Identifier: MIT
// What programs on FCL do with its managers, written once and compiled for FCL's tree and for ours: neither must need
// another source, and both must find the same. The ways are those of MoveIt, Tesseract, Drake, OpenRAVE and python-fcl.
#include <set>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

using Pairs = std::set<std::pair<int, int>>;

Pairs unordered(const Calls& calls) {
  const Calls in_order = sorted(calls);
  Pairs pairs(in_order.begin(), in_order.end());
  for (auto pair = pairs.begin(); pair != pairs.end();)
    pair = pair->first == pair->second ? pairs.erase(pair) : std::next(pair);  // FCL's trees report those
  return pairs;
}

Scene<double> some_cubes() {
  std::mt19937 random(71);
  return Scene<double>(random_cubes<double>(60, 4, random));
}

/// The world's manager by its base, a manager for each check of the robot against itself, objects that come and go.
template <class Tree>
std::vector<Pairs> as_planning_scenes_do() {
  Scene<double> world = some_cubes(), robot = some_cubes();
  std::vector<Pairs> found;
  std::unique_ptr<Base<double>> manager;
  auto tree = std::make_unique<Tree>();
  tree->tree_init_level = 2;
  manager = std::move(tree);
  for (Object<double>* object : world.pointers()) manager->registerObject(object);
  for (int check = 0; check < 3; ++check) {
    manager->unregisterObject(world.pointers()[5]);
    world[5].set(cube<double>(check, check, check));
    manager->registerObject(world.pointers()[5]);
    Calls calls;
    for (Object<double>* link : robot.pointers()) manager->collide(link, &calls, record<double>);
    found.push_back(unordered(calls));
    std::unique_ptr<Base<double>> self(new Tree);
    self->registerObjects(robot.pointers());
    calls.clear();
    self->collide(&calls, record<double>);
    found.push_back(unordered(calls));
  }
  manager->clear();
  EXPECT_TRUE(manager->empty());
  return found;
}

/// A static and a dynamic manager; objects change sides; listed objects are updated.
template <class Tree>
std::vector<Pairs> as_contact_managers_do() {
  Scene<double> scene = some_cubes();
  std::vector<Pairs> found;
  std::unique_ptr<Base<double>> still = std::make_unique<Tree>(), moving = std::make_unique<Tree>();
  for (std::size_t i = 0; i < scene.size(); ++i) (i % 3 == 0 ? moving : still)->registerObject(&scene[i]);
  still->update();
  moving->update();
  for (int step = 0; step < 4; ++step) {
    std::vector<Object<double>*> moved;
    for (std::size_t i = 0; i < scene.size(); i += 6) {
      scene[i].set(cube<double>(double(step) + 0.25 * double(i % 5), 1, 1));
      moved.push_back(&scene[i]);
    }
    moving->update(moved);
    const std::size_t side = 1 + 3 * static_cast<std::size_t>(step);
    still->unregisterObject(&scene[side]);
    moving->registerObject(&scene[side]);
    Calls calls;
    if (!still->empty()) still->collide(moving.get(), &calls, record<double>);
    moving->collide(&calls, record<double>);
    found.push_back(unordered(calls));
  }
  return found;
}

/// Managers by value among the members, copied object by object; distances below a constant.
template <class Tree>
std::vector<Pairs> as_proximity_engines_do() {
  struct Engine {
    Tree dynamic{};
    Tree anchored = {};
  } engine, copy;
  Scene<double> scene = some_cubes();
  for (std::size_t i = 0; i < scene.size(); ++i)
    (i % 2 == 0 ? engine.dynamic : engine.anchored).registerObject(&scene[i]);
  std::vector<Object<double>*> objects;
  engine.dynamic.getObjects(objects);
  for (Object<double>* object : objects) copy.dynamic.registerObject(object);
  copy.dynamic.update();
  engine.anchored.getObjects(objects);
  for (Object<double>* object : objects) copy.anchored.registerObject(object);
  Calls touching, near;
  copy.dynamic.collide(&touching, record<double>);
  copy.dynamic.collide(const_cast<Tree*>(&copy.anchored), &touching, record<double>);
  const auto within = [](Object<double>* a, Object<double>* b, void* data, double& dist) {
    dist = 0.5;
    if (a->getAABB().distance(b->getAABB()) < dist) record<double>(a, b, data);
    return false;
  };
  copy.dynamic.distance(&copy.anchored, &near, within);
  return {unordered(touching), unordered(near)};
}

/// All that can be set is, and read back; as a binding for a script does.
template <class Tree>
std::vector<Pairs> as_bindings_do() {
  Scene<double> scene = some_cubes();
  Tree* tree = new Tree();
  tree->setup();
  tree->max_tree_nonbalanced_level = 5;
  tree->tree_incremental_balance_pass = 3;
  tree->tree_topdown_balance_threshold = 4;
  tree->tree_topdown_level = 1;
  tree->tree_init_level = 1;
  tree->octree_as_geometry_collide = false;
  tree->octree_as_geometry_distance = true;
  int& threshold = tree->tree_topdown_balance_threshold;
  threshold += tree->tree_topdown_level;
  EXPECT_EQ(tree->max_tree_nonbalanced_level + tree->tree_incremental_balance_pass +
                tree->tree_topdown_balance_threshold + tree->tree_init_level,
            14);
  EXPECT_TRUE(tree->octree_as_geometry_distance && !tree->octree_as_geometry_collide);
  tree->registerObjects(scene.pointers());
  tree->update(scene.pointers()[0]);
  Calls calls;
  tree->collide(static_cast<void*>(&calls), record<double>);
  EXPECT_EQ(tree->size(), scene.size());
  delete tree;
  return {unordered(calls)};
}

using Tree = ::fcl::DynamicAABBTreeCollisionManager<double>;
using Ours = boxstream::fcl::CollisionManager<double>;

void expect_same(const std::vector<Pairs>& ours, const std::vector<Pairs>& theirs) {
  ASSERT_EQ(ours.size(), theirs.size());
  for (std::size_t i = 0; i < ours.size(); ++i) {
    EXPECT_EQ(ours[i], theirs[i]) << "answer " << i;
    EXPECT_GT(theirs[i].size(), 3U);
  }
}

TEST(Downstream, PlanningScenes) {
  expect_same(as_planning_scenes_do<Ours>(), as_planning_scenes_do<Tree>());
}
TEST(Downstream, ContactManagers) {
  expect_same(as_contact_managers_do<Ours>(), as_contact_managers_do<Tree>());
}
TEST(Downstream, ProximityEngines) {
  expect_same(as_proximity_engines_do<Ours>(), as_proximity_engines_do<Tree>());
}
TEST(Downstream, Bindings) {
  expect_same(as_bindings_do<Ours>(), as_bindings_do<Tree>());
}

TEST(Downstream, KnobsBeginAsInFclsTrees) {
  const Ours ours;
  const Tree tree;
  EXPECT_EQ(ours.max_tree_nonbalanced_level, tree.max_tree_nonbalanced_level);
  EXPECT_EQ(ours.tree_incremental_balance_pass, tree.tree_incremental_balance_pass);
  EXPECT_EQ(ours.tree_topdown_balance_threshold, tree.tree_topdown_balance_threshold);
  EXPECT_EQ(ours.tree_topdown_level, tree.tree_topdown_level);
  EXPECT_EQ(ours.tree_init_level, tree.tree_init_level);
  EXPECT_EQ(ours.octree_as_geometry_collide, tree.octree_as_geometry_collide);
  EXPECT_EQ(ours.octree_as_geometry_distance, tree.octree_as_geometry_distance);
}

}  // namespace
}  // namespace boxstream::fcl_test
