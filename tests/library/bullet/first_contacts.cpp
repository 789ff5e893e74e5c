// SPDX-License-Identifier: MIT
// When contacts of wide shapes begin: as early as with btDbvtBroadphase, and before the shapes sink into each other.
#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <memory>
#include <ostream>
#include <vector>

namespace boxstream::bullet_test {
namespace {

using boxstream::bullet::Broadphase;
using boxstream::bullet::Eager;
using boxstream::bullet::Options;

enum class Shape { box, hull, compound, offset_hull };

std::unique_ptr<btConvexHullShape> hull_of_cube(btScalar half, const btVector3& middle) {
  auto hull = std::make_unique<btConvexHullShape>();
  const btScalar reach = half - hull->getMargin();
  for (int corner = 0; corner < 8; ++corner)
    hull->addPoint(middle +
                   btVector3(corner & 1 ? reach : -reach, corner & 2 ? reach : -reach, corner & 4 ? reach : -reach));
  return hull;
}

/// A cube that falls flat on the ground, at some height above it.
struct Fall {
  Shape shape;
  btScalar half, speed;
  bool continuous, relative_threshold;
};

std::ostream& operator<<(std::ostream& out, const Fall& fall) {
  return out << "shape " << int(fall.shape) << ", half side " << fall.half << ", speed " << fall.speed
             << (fall.continuous ? ", continuous" : "") << (fall.relative_threshold ? "" : ", absolute threshold");
}

struct Contact {
  int step = -1;
  btScalar distance = 0;  ///< of its first points
  btScalar deepest = 0;
};

Contact first_contact(const Fall& fall, btScalar height, std::unique_ptr<btBroadphaseInterface> broadphase) {
  btDefaultCollisionConfiguration config;
  btCollisionDispatcher dispatcher(&config);
  if (!fall.relative_threshold)
    dispatcher.setDispatcherFlags(dispatcher.getDispatcherFlags() &
                                  ~btCollisionDispatcher::CD_USE_RELATIVE_CONTACT_BREAKING_THRESHOLD);
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world(&dispatcher, broadphase.get(), &solver, &config);
  world.getDispatchInfo().m_useContinuous = fall.continuous;
  const bool is_offset = fall.shape == Shape::offset_hull;
  const btVector3 middle(0, is_offset ? 3 * fall.half : btScalar(0), 0);
  const auto hull = hull_of_cube(fall.half, middle);
  btBoxShape box(btVector3(fall.half, fall.half, fall.half));
  btCompoundShape compound;
  btCollisionShape* shape = hull.get();
  if (fall.shape == Shape::box) shape = &box;
  if (fall.shape == Shape::compound) {
    btTransform at;
    at.setIdentity();
    compound.addChildShape(at, hull.get());
    shape = &compound;
  }
  btBoxShape slab(btVector3(40, 1, 40));
  btRigidBody ground(0, nullptr, &slab), body(1, nullptr, shape, btVector3(1, 1, 1));
  btTransform at;
  at.setIdentity();
  at.setOrigin(btVector3(0, -1, 0));
  ground.setWorldTransform(at);
  const btScalar lowest = fall.half - middle.y();  // below the origin of the body
  at.setOrigin(btVector3(0, lowest + height, 0));
  body.setWorldTransform(at);
  body.setLinearVelocity(btVector3(0, -fall.speed, 0));
  body.setAngularFactor(0);
  world.addRigidBody(&ground);
  world.addRigidBody(&body);
  Contact contact;
  for (int step = 0; step < 30; ++step) {
    world.stepSimulation(btScalar(1) / 60, 0);
    contact.deepest = std::min(contact.deepest, body.getWorldTransform().getOrigin().y() - lowest);
    for (int m = 0; contact.step < 0 && m < dispatcher.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(m);
      for (int i = 0; i < manifold.getNumContacts(); ++i) {
        contact.step = step;
        contact.distance =
            std::min(i == 0 ? btScalar(1e9) : contact.distance, manifold.getContactPoint(i).getDistance());
      }
    }
  }
  world.removeRigidBody(&body);
  world.removeRigidBody(&ground);
  return contact;
}

TEST(BulletFirstContacts, BeginAsEarlyAsWithBulletsOwn) {
  int sinks_with_exact_boxes = 0;
  for (const Shape shape : {Shape::box, Shape::hull, Shape::compound, Shape::offset_hull})
    for (const btScalar half : {btScalar(0.4), btScalar(2.5), btScalar(7)})
      for (const bool continuous : {false, true})
        for (const bool relative : {false, true})
          for (int i = 0; i < 12; ++i) {
            const Fall fall{shape, half, btScalar(9.5), continuous, relative};
            const btScalar height = btScalar(0.25) + btScalar(0.013) * btScalar(i);
            SCOPED_TRACE(fall);
            const Contact theirs = first_contact(fall, height, std::make_unique<btDbvtBroadphase>());
            for (const Eager eager : {Eager::ghosts, Eager::all}) {
              Options options;
              options.eager = eager;
              const Contact ours = first_contact(fall, height, std::make_unique<Broadphase>(options));
              ASSERT_EQ(ours.step, theirs.step);
              ASSERT_EQ(ours.distance, theirs.distance);
              ASSERT_EQ(ours.deepest, theirs.deepest);
            }
            Options exact;
            exact.exact_boxes = true;
            sinks_with_exact_boxes += first_contact(fall, height, std::make_unique<Broadphase>(exact)).deepest <
                                      theirs.deepest - btScalar(0.02);
          }
  EXPECT_GT(sinks_with_exact_boxes, 5) << "nothing was put to the test";
}

/// What a pair of boxes may be apart.
btScalar widest_gap(const Options& options, btScalar half, btCollisionShape* shape) {
  btDefaultCollisionConfiguration config;
  btCollisionDispatcher dispatcher(&config);
  Broadphase broadphase(options);
  btCollisionObject objects[2];
  btBroadphaseProxy* proxies[2];
  const btVector3 size(half, half, half), bit(btScalar(0.001), 0, 0);
  for (int i = 0; i < 2; ++i) {
    objects[i].setCollisionShape(shape);
    proxies[i] = broadphase.createProxy(-size, size, 0, &objects[i], 1, -1, &dispatcher);
    objects[i].setBroadphaseHandle(proxies[i]);
  }
  btScalar gap = 0;
  for (; gap < 1; gap += bit.x()) {
    const btVector3 apart(2 * half + gap, 0, 0);
    broadphase.setAabb(proxies[0], -size - bit, size, &dispatcher);
    broadphase.setAabb(proxies[1], apart - size, apart + size, &dispatcher);
    broadphase.calculateOverlappingPairs(&dispatcher);
    broadphase.validate();
    if (broadphase.getOverlappingPairCache()->getNumOverlappingPairs() == 0) break;
  }
  for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, &dispatcher);
  return gap;
}

TEST(BulletFirstContacts, ReachAsFarAsManifoldsAndNoFartherThanBulletsOwnBoxes) {
  btBoxShape small(btVector3(1, 1, 1)), wide(btVector3(2, 2, 2)), huge(btVector3(50, 50, 50));
  const Options usual;
  // What boxes cover is 0.02 each; angular motion discs are 1.73, 3.46 and 87.
  EXPECT_NEAR(widest_gap(usual, 1, &small), 0, 0.002);
  EXPECT_NEAR(widest_gap(usual, 2, &wide), 0.0693 - 0.04, 0.002);
  EXPECT_NEAR(widest_gap(usual, 50, &huge), 0.1, 0.002);
  EXPECT_NEAR(widest_gap(usual, 2, nullptr), 0.0693 - 0.04, 0.002) << "by the box";
  Options none;
  none.eager = Eager::none;
  EXPECT_NEAR(widest_gap(none, 2, &huge), 0.0693 - 0.04, 0.002) << "by the box";
  EXPECT_NEAR(widest_gap(usual, 2, &huge), 0.1, 0.002) << "by the shape";
  Options margin;
  margin.margin = btScalar(0.03);
  EXPECT_NEAR(widest_gap(margin, 50, &huge), 0.1, 0.002) << "a margin counts";
  Options exact;
  exact.exact_boxes = true;
  EXPECT_NEAR(widest_gap(exact, 50, &huge), 0, 0.002);
}

}  // namespace
}  // namespace boxstream::bullet_test
