// SPDX-License-Identifier: MIT
#pragma once

#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "bullet/support.hpp"

namespace boxstream::worlds_test {

using bullet_test::Kind;
using bullet_test::Random;
using bullet_test::Room;

/// What the tables call it: boxstream, dbvt, dbvt-deferred, sap, simple.
const char* name_of(Kind kind);
inline const std::vector<Kind> kinds{Kind::subject, Kind::dbvt, Kind::dbvt_deferred, Kind::axis32, Kind::simple};

/// "float" or "double": that of the Bullet this is built for.
const char* precision();
inline constexpr bool is_double = sizeof(btScalar) == 8;

/// A world of rigid bodies with nothing in it but Bullet, for what scene files cannot say. Owns everything in it, and
/// checks when it is taken apart that no pair and no algorithm is left.
class PlainWorld {
 public:
  explicit PlainWorld(Kind kind, const Room& room = {});
  explicit PlainWorld(std::unique_ptr<btBroadphaseInterface> broadphase, bool exact = true);
  ~PlainWorld();
  PlainWorld(const PlainWorld&) = delete;
  PlainWorld& operator=(const PlainWorld&) = delete;

  template <class Shape, class... Args>
  Shape* shape(Args&&... args) {
    auto made = std::make_unique<Shape>(std::forward<Args>(args)...);
    Shape* raw = made.get();
    shapes_.push_back(std::move(made));
    return raw;
  }
  /// No mass: static.
  btRigidBody& add(btScalar mass, btCollisionShape* shape, const btVector3& at,
                   const btQuaternion& turned = btQuaternion::getIdentity());
  /// A box of 20 x 2 x 20 whose upper side is in the plane of `at`.
  btRigidBody& add_ground(const btVector3& at = btVector3(0, 0, 0));
  /// Takes the body with this number out and deletes it; the last one gets its number.
  void remove(std::size_t body);
  void add(std::unique_ptr<btTypedConstraint> joint, bool collide);
  void clear();
  /// Ends all pairs at once. Bullet's own caches go through all of them for each body that goes.
  void end_all_pairs();

  void step(btScalar dt = btScalar(1) / 60) { world->stepSimulation(dt, 0); }

  /// Pairs against a search among the boxes, right after a step. Broad-phases that are not exact may hold more.
  testing::AssertionResult check_pairs() const;
  /// How many pairs of overlapping boxes are not held.
  std::size_t missed_pairs() const;
  /// Pairs of bodies by their user indices, lower one first, whose boxes overlap and that are held, sorted.
  std::vector<std::pair<int, int>> held_pairs() const;

  bool is_finite() const;
  bool all_asleep() const;
  /// Places, rotations and velocities of the first `count` bodies.
  std::uint64_t state_hash(std::size_t count) const;
  std::uint64_t state_hash() const { return state_hash(bodies.size()); }

  btDefaultCollisionConfiguration config;
  bullet_test::CountingDispatcher dispatcher{&config};
  std::unique_ptr<btBroadphaseInterface> broadphase;
  btSequentialImpulseConstraintSolver solver;
  std::unique_ptr<btDiscreteDynamicsWorld> world;
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  std::vector<std::unique_ptr<btTypedConstraint>> joints;

 private:
  bool exact_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
};

}  // namespace boxstream::worlds_test
