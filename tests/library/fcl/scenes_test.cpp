// SPDX-License-Identifier: MIT
// Whole queries with FCL's narrow phase and its default callbacks, on random environments of the kind that FCL tests
// its own managers with: the naive manager, which tries all pairs, is the witness. Double only, as FCL's library.
#include <array>
#include <cmath>

#include <fcl/broadphase/broadphase_bruteforce.h>
#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/broadphase/default_broadphase_callbacks.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/octree/octree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/math/bv/OBBRSS.h>

#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

using S = double;
using Environment = std::vector<std::unique_ptr<Object<S>>>;

::fcl::Vector3d random_vector(std::mt19937& random, double reach) {
  std::uniform_real_distribution<double> u(-reach, reach);
  const double x = u(random), y = u(random), z = u(random);
  return {x, y, z};
}

::fcl::Matrix3d random_turn(std::mt19937& random, double most) {
  std::uniform_real_distribution<double> u(-most, most);
  // One after the other, here and below, for compilers differ in which argument they compute first.
  const ::fcl::Vector3d axis = random_vector(random, 1).normalized();
  return ::fcl::AngleAxisd(u(random), axis).toRotationMatrix();
}

/// A box with four triangles a side.
std::shared_ptr<::fcl::CollisionGeometry<S>> mesh_of_box(const ::fcl::Vector3d& half) {
  auto mesh = std::make_shared<::fcl::BVHModel<::fcl::OBBRSS<S>>>();
  mesh->beginModel();
  for (int d = 0; d < 3; ++d)
    for (const double side : {-1.0, 1.0}) {
      const auto at = [&](double u, double v) {
        ::fcl::Vector3d p;
        p[d] = side * half[d];
        p[(d + 1) % 3] = u * half[(d + 1) % 3];
        p[(d + 2) % 3] = v * half[(d + 2) % 3];
        return p;
      };
      const ::fcl::Vector3d middle = at(0, 0);
      const std::array<::fcl::Vector3d, 5> round = {at(-1, -1), at(1, -1), at(1, 1), at(-1, 1), at(-1, -1)};
      for (std::size_t i = 0; i < 4; ++i) mesh->addTriangle(middle, round[i], round[i + 1]);
    }
  mesh->endModel();
  return mesh;
}

/// As many boxes, spheres and cylinders, or meshes instead, anywhere within `reach` and turned any way.
Environment environment(std::mt19937& random, int of_each, double reach, bool meshes) {
  Environment objects;
  const auto put = [&](const std::shared_ptr<::fcl::CollisionGeometry<S>>& geometry) {
    const ::fcl::Vector3d at = random_vector(random, reach);
    const ::fcl::Matrix3d turn = random_turn(random, M_PI);
    objects.push_back(std::make_unique<Object<S>>(geometry, turn, at));
    objects.back()->computeAABB();
  };
  for (int i = 0; i < of_each; ++i) {
    if (meshes) {
      put(mesh_of_box({2.5, 5, 10}));
      put(mesh_of_box({8, 8, 8}));
      put(mesh_of_box({4, 4, 20}));
    } else {
      put(std::make_shared<::fcl::Boxd>(5, 10, 20));
      put(std::make_shared<::fcl::Sphered>(15));
      put(std::make_shared<::fcl::Cylinderd>(10, 40));
    }
  }
  return objects;
}

/// Up to 10 degrees and 1 % of the reach.
void move(Environment& objects, std::mt19937& random, double reach) {
  for (const auto& object : objects) {
    const ::fcl::Matrix3d turn = random_turn(random, M_PI / 18);
    object->setTransform(turn * object->getRotation(), object->getTranslation() + random_vector(random, reach / 100));
    object->computeAABB();
  }
}

std::vector<Object<S>*> pointers(const Environment& objects) {
  std::vector<Object<S>*> list;
  for (const auto& object : objects) list.push_back(object.get());
  return list;
}

/// The managers of one environment: ours, and FCL's that try all pairs or have a tree.
struct Managers {
  Manager<S> ours;
  ::fcl::NaiveCollisionManager<S> naive;
  ::fcl::DynamicAABBTreeCollisionManager<S> tree;

  explicit Managers(const Environment& objects) {
    each([&](Base<S>& manager) {
      manager.registerObjects(pointers(objects));
      manager.setup();
    });
  }
  template <class Do>
  void each(Do&& act) {
    act(ours);
    act(naive);
    act(tree);
  }
};

/// Contacts that FCL's default callback collects, up to `most`; `ask(data)` runs the query.
template <class Ask>
std::size_t contacts(std::size_t most, Ask&& ask) {
  ::fcl::DefaultCollisionData<S> data;
  data.request.enable_contact = most > 1;
  data.request.num_max_contacts = most;
  ask(&data);
  return data.result.numContacts();
}

void expect_same_contacts(Managers& managers, const Environment& queries) {
  std::size_t found = 0;
  for (const std::size_t most : {std::size_t{1}, std::size_t{10}, std::size_t{100000}}) {
    const auto self = [&](const Base<S>& manager) {
      return contacts(most, [&](void* data) { manager.collide(data, ::fcl::DefaultCollisionFunction<S>); });
    };
    EXPECT_EQ(self(managers.ours), self(managers.naive)) << "at most " << most;
    found += self(managers.ours);
    for (const auto& query : queries) {
      const auto one = [&](const Base<S>& manager) {
        return contacts(most,
                        [&](void* data) { manager.collide(query.get(), data, ::fcl::DefaultCollisionFunction<S>); });
      };
      EXPECT_EQ(one(managers.ours), one(managers.naive)) << "at most " << most;
      found += one(managers.ours);
    }
  }
  EXPECT_GT(found, 100U);
}

TEST(Scenes, CollideAndUpdate) {
  for (const int of_each : {30, 150}) {
    std::mt19937 random(static_cast<unsigned>(of_each));
    const double reach = of_each == 30 ? 60 : 120;
    Environment objects = environment(random, of_each, reach, false);
    const Environment queries = environment(random, 5, reach, false);
    Managers managers(objects);
    for (int frame = 0; frame < 3; ++frame) {
      expect_same_contacts(managers, queries);
      move(objects, random, reach);
      managers.each([](Base<S>& manager) { manager.update(); });
    }
    expect_same_contacts(managers, queries);
  }
}

TEST(Scenes, CollideMeshesAndUpdate) {
  std::mt19937 random(77);
  Environment objects = environment(random, 12, 40, true);
  const Environment queries = environment(random, 2, 40, true);
  Managers managers(objects);
  expect_same_contacts(managers, queries);
  move(objects, random, 40);
  managers.each([](Base<S>& manager) { manager.update(); });
  expect_same_contacts(managers, queries);
}

TEST(Scenes, Empty) {
  Environment none;
  Managers managers(none);
  std::mt19937 random(1);
  const Environment queries = environment(random, 1, 10, false);
  EXPECT_EQ(contacts(10, [&](void* data) { managers.ours.collide(data, ::fcl::DefaultCollisionFunction<S>); }), 0U);
  EXPECT_EQ(
      contacts(10,
               [&](void* data) { managers.ours.collide(queries[0].get(), data, ::fcl::DefaultCollisionFunction<S>); }),
      0U);
}

/// What the default callback makes of a query, and how often it is called.
struct Measured {
  ::fcl::DistanceResultd result;
  ::fcl::DistanceRequestd request;
  std::size_t calls = 0;
  bool done = false;

  static bool run(Object<S>* a, Object<S>* b, void* data, S& dist) {
    Measured& measured = *static_cast<Measured*>(data);
    ++measured.calls;
    if (measured.done) {
      dist = measured.result.min_distance;
      return true;
    }
    ::fcl::distance(a, b, measured.request, measured.result);
    dist = measured.result.min_distance;
    return dist <= 0;
  }
};

struct Counts {
  std::size_t ours = 0, tree = 0;
};

/// The least distance is that of all pairs; callbacks are counted beside the tree's.
template <class Ask>
void expect_same_distance(Managers& managers, Counts& counts, Ask&& ask) {
  Measured ours, naive, tree;
  ask(managers.ours, &ours);
  ask(managers.naive, &naive);
  ask(managers.tree, &tree);
  const double least = naive.result.min_distance;
  if (least <= 0)
    EXPECT_LE(ours.result.min_distance, 0);
  else
    EXPECT_NEAR(ours.result.min_distance, least, 1e-5 * least);
  counts.ours += ours.calls;
  counts.tree += tree.calls;
}

void expect_same_distances(Environment objects, const Environment& queries) {
  Managers managers(objects);
  Counts self, one, cross;
  expect_same_distance(managers, self,
                       [](const Base<S>& manager, void* data) { manager.distance(data, Measured::run); });
  for (const auto& query : queries)
    expect_same_distance(
        managers, one, [&](const Base<S>& manager, void* data) { manager.distance(query.get(), data, Measured::run); });
  // Each with another of its own type.
  Managers others(queries);
  expect_same_distance(managers, cross, [&](const Base<S>& manager, void* data) {
    Base<S>* other = &others.tree;
    if (&manager == &managers.ours) other = &others.ours;
    if (&manager == &managers.naive) other = &others.naive;
    manager.distance(other, data, Measured::run);
  });
  EXPECT_LE(self.ours + one.ours + cross.ours, self.tree + one.tree + cross.tree);
  ::testing::Test::RecordProperty("self", std::to_string(self.ours) + " calls, tree " + std::to_string(self.tree));
  ::testing::Test::RecordProperty("object", std::to_string(one.ours) + " calls, tree " + std::to_string(one.tree));
  ::testing::Test::RecordProperty("cross", std::to_string(cross.ours) + " calls, tree " + std::to_string(cross.tree));
}

TEST(Distances, DenseEnvironment) {
  std::mt19937 random(5);
  Environment objects = environment(random, 40, 200, false);
  expect_same_distances(std::move(objects), environment(random, 10, 200, false));
}

TEST(Distances, SparseEnvironment) {
  std::mt19937 random(6);
  Environment objects = environment(random, 60, 2000, false);
  expect_same_distances(std::move(objects), environment(random, 10, 2000, false));
}

TEST(Distances, Meshes) {
  std::mt19937 random(7);
  Environment objects = environment(random, 8, 300, true);
  expect_same_distances(std::move(objects), environment(random, 3, 300, true));
}

/// Things in rows with gaps between them: all far apart from each other, many of them equally.
TEST(Distances, GridOfBoxes) {
  std::mt19937 random(8);
  Environment objects;
  const auto box = std::make_shared<::fcl::Boxd>(5, 10, 20);
  const auto cylinder = std::make_shared<::fcl::Cylinderd>(5, 20);
  for (int i = 0; i < 343; ++i) {
    const ::fcl::Vector3d at(30 * (i % 7), 30 * (i / 7 % 7), 30 * (i / 49));
    const std::shared_ptr<::fcl::CollisionGeometry<S>> geometry =
        i % 2 == 0 ? std::shared_ptr<::fcl::CollisionGeometry<S>>(box) : cylinder;
    objects.push_back(
        std::make_unique<Object<S>>(geometry, ::fcl::Matrix3d::Identity(), at + random_vector(random, 1)));
    objects.back()->computeAABB();
  }
  expect_same_distances(std::move(objects), environment(random, 10, 200, false));
}

/// Section 1.6: an octree is taken by its box, managed or asking, and FCL's narrow phase does the rest.
TEST(Octrees, AreTakenByTheirBoxes) {
  const auto tree = std::make_shared<::octomap::OcTree>(0.5);
  tree->updateNode(::octomap::point3d(1, 1, 1), true);
  Object<S> octree(std::make_shared<::fcl::OcTree<S>>(tree));
  octree.computeAABB();
  Object<S> inside(std::make_shared<::fcl::Sphered>(1)), beside(std::make_shared<::fcl::Sphered>(1));
  inside.setTranslation(::fcl::Vector3d(1, 1, 1));
  beside.setTranslation(::fcl::Vector3d(9, 1, 1));
  for (Object<S>* object : {&inside, &beside}) object->computeAABB();
  using Pairs = std::vector<std::pair<Object<S>*, Object<S>*>>;
  const auto collect = [](Object<S>* a, Object<S>* b, void* data) {
    static_cast<Pairs*>(data)->push_back({a, b});
    return false;
  };
  Manager<S> manager;
  manager.registerObjects({&inside, &beside});
  Pairs pairs;
  manager.collide(&octree, &pairs, collect);
  EXPECT_EQ(pairs, (Pairs{{&inside, &octree}, {&beside, &octree}}));
  EXPECT_EQ(contacts(100, [&](void* data) { manager.collide(&octree, data, ::fcl::DefaultCollisionFunction<S>); }) > 0,
            true);
  pairs.clear();
  manager.distance(&octree, &pairs, [](Object<S>* a, Object<S>* b, void* data, S&) {
    static_cast<Pairs*>(data)->push_back({a, b});
    return false;
  });
  EXPECT_EQ(pairs.size(), 2U);
  pairs.clear();
  manager.registerObject(&octree);
  manager.collide(&pairs, collect);
  EXPECT_EQ(pairs, (Pairs{{&inside, &octree}, {&beside, &octree}}));
}

}  // namespace
}  // namespace boxstream::fcl_test
