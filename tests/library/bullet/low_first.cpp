// SPDX-License-Identifier: MIT
// The solver that takes contacts from the ground up.
#include <boxstream/bullet/low_first.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <BulletCollision/CollisionDispatch/btSimulationIslandManager.h>
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

namespace boxstream::bullet_test {
namespace {

using boxstream::bullet::LowFirst;

/// Notes how high what it is given is: the middle of what the boxes of two bodies share.
class Spy : public btSequentialImpulseConstraintSolver {
 public:
  std::vector<btScalar> heights;

 protected:
  void convertContacts(btPersistentManifold** manifolds, int count, const btContactSolverInfo& info) override {
    if (count == 0) return;  // bodies that touch nothing
    heights.clear();
    for (int i = 0; i < count; ++i) {
      const btBroadphaseProxy& a = *manifolds[i]->getBody0()->getBroadphaseHandle();
      const btBroadphaseProxy& b = *manifolds[i]->getBody1()->getBroadphaseHandle();
      const btScalar low = std::max(a.m_aabbMin.y(), b.m_aabbMin.y());
      heights.push_back((low + std::min(a.m_aabbMax.y(), b.m_aabbMax.y())) / 2);
    }
    btSequentialImpulseConstraintSolver::convertContacts(manifolds, count, info);
  }
};

enum class Created { from_ground, from_top, alternately };

/// A square pyramid of unit cubes on a floor.
class Pyramid {
 public:
  Pyramid(btConstraintSolver& solver, Created created, int levels = 7)
      : world_(&dispatcher_, &broadphase_, &solver, &configuration_) {
    add(floor_, 0, {0, -1, 0});
    std::vector<btVector3> places;
    for (int level = 0; level < levels; ++level)
      for (int i = 0; i < (levels - level) * (levels - level); ++i) {
        const int side = levels - level;
        places.emplace_back(btScalar(i % side) - btScalar(side - 1) / 2, btScalar(level) + btScalar(0.5),
                            btScalar(i / side) - btScalar(side - 1) / 2);
      }
    if (created == Created::from_top) std::reverse(places.begin(), places.end());
    for (std::size_t i = 0; i < places.size(); ++i)
      add(cube_, 1, places[created == Created::alternately ? i * 37 % places.size() : i]);
  }
  ~Pyramid() {
    for (const auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  Pyramid(const Pyramid&) = delete;
  Pyramid& operator=(const Pyramid&) = delete;

  void step(int steps) {
    for (int i = 0; i < steps; ++i) world_.stepSimulation(btScalar(1) / 60, 0);
  }

  /// Root of the mean square of all contacts' depths.
  double depth() {
    double sum = 0, count = 0;
    for (int i = 0; i < dispatcher_.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(i);
      for (int k = 0; k < manifold.getNumContacts(); ++k, ++count)
        sum += std::pow(std::min(0.0, double{manifold.getContactPoint(k).getDistance()}), 2);
    }
    return std::sqrt(sum / count);
  }

  btDiscreteDynamicsWorld& world() { return world_; }
  btVector3 last_place() const { return bodies_.back()->getWorldTransform().getOrigin(); }

 private:
  void add(btBoxShape& shape, btScalar mass, const btVector3& place) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    bodies_.push_back(std::make_unique<btRigidBody>(mass, nullptr, &shape, inertia));
    bodies_.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), place));
    bodies_.back()->setActivationState(DISABLE_DEACTIVATION);
    world_.addRigidBody(bodies_.back().get());
  }

  btBoxShape floor_{{30, 1, 30}}, cube_{{btScalar(0.5), btScalar(0.5), btScalar(0.5)}};
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  boxstream::bullet::Broadphase broadphase_;
  btDiscreteDynamicsWorld world_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
};

TEST(BulletLowFirst, SolvesFromTheGroundUp) {
  for (const bool split_islands : {true, false}) {
    LowFirst<Spy> solver;
    Pyramid pyramid(solver, Created::from_top);
    pyramid.world().getSimulationIslandManager()->setSplitIslands(split_islands);
    pyramid.step(5);
    ASSERT_GT(solver.heights.size(), 100u);
    EXPECT_TRUE(std::is_sorted(solver.heights.begin(), solver.heights.end()));
    EXPECT_LT(solver.heights.front(), btScalar(0.1));
    EXPECT_GT(solver.heights.back(), btScalar(5.9));
  }
}

TEST(BulletLowFirst, UpIsWhereverItIsSaidToBe) {
  LowFirst<Spy> solver(btVector3(0, -1, 0));
  Pyramid pyramid(solver, Created::from_ground);
  pyramid.step(5);
  ASSERT_GT(solver.heights.size(), 100u);
  EXPECT_GT(solver.heights.front(), solver.heights.back() + 4);
}

/// Without islands solvers are given the dispatcher's own array, whose order its entries know.
TEST(BulletLowFirst, LeavesTheDispatchersArrayAlone) {
  LowFirst<> solver;
  Pyramid pyramid(solver, Created::from_top);
  pyramid.world().getSimulationIslandManager()->setSplitIslands(false);
  pyramid.step(3);
  btDispatcher& dispatcher = *pyramid.world().getDispatcher();
  ASSERT_GT(dispatcher.getNumManifolds(), 100);
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i)
    EXPECT_EQ(dispatcher.getManifoldByIndexInternal(i)->m_index1a, i);
}

TEST(BulletLowFirst, ContactsInAStackAreLessDeepHoweverItWasBuilt) {
  for (const Created created : {Created::from_ground, Created::from_top, Created::alternately}) {
    btSequentialImpulseConstraintSolver usual;
    LowFirst<> low_first;
    Pyramid with_usual(usual, created), with_low_first(low_first, created);
    with_usual.step(60);
    with_low_first.step(60);
    double usual_depth = 0, depth = 0;
    for (int i = 0; i < 20; ++i) {
      with_usual.step(1);
      with_low_first.step(1);
      usual_depth += with_usual.depth() / 20;
      depth += with_low_first.depth() / 20;
    }
    EXPECT_LT(depth, 0.8 * usual_depth) << "created in way " << static_cast<int>(created);
    EXPECT_LT(usual_depth, 1e-3);
  }
}

TEST(BulletLowFirst, IsAFunctionOfTheState) {
  LowFirst<> one, other;
  Pyramid first(one, Created::alternately), second(other, Created::alternately);
  first.step(40);
  second.step(40);
  EXPECT_TRUE(first.last_place() == second.last_place());
}

}  // namespace
}  // namespace boxstream::bullet_test
