// SPDX-License-Identifier: MIT
// One body among others becomes NaN in mid-run.
#include <limits>
#include <string>

#include "judge.hpp"

namespace boxstream::worlds_test {
namespace {

const btScalar half = btScalar(0.5);
const btScalar nan = std::numeric_limits<btScalar>::quiet_NaN();

class Nan : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Nan, testing::ValuesIn(kinds), [](const auto& test) { return test_name(test.param); });

/// Forty bodies that fall in a heap, and one more.
btRigidBody& drop(PlainWorld& world, const btVector3& last_at) {
  world.add_ground();
  Random random(18);
  btCollisionShape* const shapes[] = {world.shape<btBoxShape>(btVector3(half, half, half)),
                                      world.shape<btSphereShape>(half)};
  for (int i = 0; i < 40; ++i)
    world.add(1, shapes[i % 2], btVector3(random.real(-2, 2), btScalar(0.6) + btScalar(i) / 5, random.real(-2, 2)));
  return world.add(1, shapes[0], last_at);
}

void make_nan(btRigidBody& body) {
  body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(nan, nan, nan)));
  body.setLinearVelocity(btVector3(nan, nan, nan));
  body.setAngularVelocity(btVector3(nan, nan, nan));
}

void put_away(btRigidBody& body) {
  body.setWorldTransform(btTransform(btQuaternion::getIdentity(), btVector3(150, 150, 150)));
  body.setLinearVelocity(btVector3(0, 0, 0));
  body.setAngularVelocity(btVector3(0, 0, 0));
}

/// Steps, of 150, after which the others are not what they are in a world where the last body is put away instead.
template <class Spoil>
int differing_steps(Kind kind, const btVector3& last_at, Spoil spoil) {
  PlainWorld world(kind), other(kind);
  btRigidBody& doomed = drop(world, last_at);
  btRigidBody& moved = drop(other, last_at);
  const std::size_t others = world.bodies.size() - 1;
  for (int i = 0; i < 60; ++i) {
    world.step();
    other.step();
  }
  EXPECT_EQ(world.state_hash(), other.state_hash());
  spoil(world, doomed);
  put_away(moved);
  int differing = 0;
  for (int i = 0; i < 150; ++i) {
    world.step();
    other.step();
    differing += world.state_hash(others) != other.state_hash(others);
  }
  EXPECT_TRUE(other.is_finite());
  return differing;
}

TEST_P(Nan, ABodyThatFliesAlone) {
  const int differing = differing_steps(GetParam(), btVector3(0, 60, 0), [](PlainWorld&, btRigidBody& body) {
    body.setLinearVelocity(btVector3(nan, nan, nan));  // Bullet does the rest
  });
  judge("NaN, flying alone", "steps that differ from a world without it == 0", GetParam(), differing, differing == 0,
        Asked::of_boxstream);
}

/// Bullet does not pass on a box that is NaN, so the world does it here, as soft bodies do it.
TEST_P(Nan, ABodyInTheHeapWhoseBoxBecomesNaN) {
  struct Case {
    const char* world;
    btVector3 lo, hi;
  };
  for (const Case& spoilt :
       {Case{"NaN in the heap, all of its box", btVector3(nan, nan, nan), btVector3(nan, nan, nan)},
        Case{"NaN in the heap, one side of its box", btVector3(-9, nan, -9), btVector3(9, 9, 9)},
        Case{"NaN in the heap, its box inverted", btVector3(9, 9, 9), btVector3(-9, -9, -9)}}) {
    const int differing = differing_steps(
        GetParam(), btVector3(btScalar(0.3), 3, btScalar(0.2)), [&](PlainWorld& world, btRigidBody& body) {
          make_nan(body);
          world.broadphase->setAabb(body.getBroadphaseProxy(), spoilt.lo, spoilt.hi, &world.dispatcher);
        });
    judge(spoilt.world, "steps that differ from a world without it == 0", GetParam(), differing, differing == 0,
          Asked::of_boxstream);
  }
}

}  // namespace
}  // namespace boxstream::worlds_test
