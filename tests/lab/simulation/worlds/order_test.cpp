// SPDX-License-Identifier: MIT
// Trajectories against brute force in the same order, in this precision of Bullet; and the same bodies put in in other
// orders. What scenes say is in neutral_test.cpp.
#include <algorithm>
#include <numeric>
#include <vector>

#include "brute_force.hpp"
#include "judge.hpp"
#include "sizes.hpp"

namespace boxstream::worlds_test {
namespace {

const btScalar half = btScalar(0.5);

/// Boxes, balls and capsules in a heap, a chain among them, and some that come and go.
void stir(PlainWorld& world, int step, Random& random) {
  if (step == 0) {
    world.add_ground();
    auto* link = world.shape<btCapsuleShape>(btScalar(0.2), btScalar(0.4));
    btCollisionShape* const shapes[] = {world.shape<btBoxShape>(btVector3(half, half, half)),
                                        world.shape<btSphereShape>(half), link};
    for (int i = 0; i < 150; ++i)
      world.add(1, shapes[i % 3], btVector3(random.real(-2, 2), btScalar(0.6) + btScalar(i) / 8, random.real(-2, 2)));
    for (std::size_t i = 1; i < 8; ++i)
      world.add(std::make_unique<btPoint2PointConstraint>(*world.bodies[3 * i], *world.bodies[3 * i + 3],
                                                          btVector3(0, half, 0), btVector3(0, -half, 0)),
                false);
  }
  if (step % 10 == 9) {
    world.remove(40 + static_cast<std::size_t>(random.below(100)));  // none of the chain's
    world.add(1, world.bodies[60]->getCollisionShape(), btVector3(random.real(-2, 2), 8, random.real(-2, 2)));
  }
}

TEST(Neutral, AHeapMovesAsWithBruteForceInThisPrecision) {
  PlainWorld world(Kind::subject), other(std::make_unique<BruteForce>());
  Random random(20), same(20);
  const int steps = size_of_run(600, 600);
  for (int step = 0; step < steps; ++step) {
    stir(world, step, random);
    stir(other, step, same);
    world.step();
    other.step();
    ASSERT_EQ(bullet_test::pairs_of(*world.broadphase), bullet_test::pairs_of(*other.broadphase))
        << "step " << step + 1;
    ASSERT_EQ(world.state_hash(), other.state_hash()) << "step " << step + 1;
  }
  EXPECT_GT(world.held_pairs().size(), 100u);
}

class Order : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Order, testing::ValuesIn(kinds), [](const auto& test) { return test_name(test.param); });

/// Balls that fly through each other, so that no path depends on the order of pairs.
std::vector<std::vector<std::pair<int, int>>> pairs_of_flight(Kind kind, const std::vector<int>& order) {
  PlainWorld world(kind);
  world.world->setGravity(btVector3(0, 0, 0));
  world.dispatcher.setNearCallback([](btBroadphasePair&, btCollisionDispatcher&, const btDispatcherInfo&) {});
  auto* ball = world.shape<btSphereShape>(half);
  for (const int name : order) {
    Random random(static_cast<std::uint64_t>(name) + 100);
    btRigidBody& body = world.add(1, ball, random.vector(-6, 6));
    body.setLinearVelocity(random.vector(-4, 4));
    body.setActivationState(DISABLE_DEACTIVATION);
    body.setUserIndex(name);
  }
  std::vector<std::vector<std::pair<int, int>>> pairs;
  for (int step = 0; step < 100; ++step) {
    world.step();
    pairs.push_back(world.held_pairs());
  }
  return pairs;
}

TEST_P(Order, ShuffledBodiesHaveTheSamePairs) {
  std::vector<int> order(200);
  std::iota(order.begin(), order.end(), 0);
  const auto expected = pairs_of_flight(GetParam(), order);
  ASSERT_GT(expected.front().size(), 20u);
  ASSERT_NE(expected.front(), expected.back());
  Random random(5);
  for (int shuffle = 0; shuffle < 3; ++shuffle) {
    for (int i = 200; i > 1; --i)
      std::swap(order[static_cast<std::size_t>(i) - 1], order[static_cast<std::size_t>(random.below(i))]);
    EXPECT_EQ(pairs_of_flight(GetParam(), order), expected);
  }
}

}  // namespace
}  // namespace boxstream::worlds_test
