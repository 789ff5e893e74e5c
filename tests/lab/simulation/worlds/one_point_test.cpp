// SPDX-License-Identifier: MIT
// Everything at one point.
#include <string>

#include "heap_watch.hpp"
#include "judge.hpp"
#include "sizes.hpp"

namespace boxstream::worlds_test {
namespace {

namespace heap_watch = boxstream::tests::heap_watch;

class OnePoint : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, OnePoint, testing::ValuesIn(kinds),
                         [](const auto& test) { return test_name(test.param); });

void meet(PlainWorld& world, int bodies) {
  world.world->setGravity(btVector3(0, 0, 0));
  auto* ball = world.shape<btSphereShape>(btScalar(0.5));
  for (int i = 0; i < bodies; ++i) world.add(1, ball, btVector3(0, 0, 0));
}

std::string size_name(int bodies) {
  return ", " + std::to_string(bodies) + " bodies";
}

double all_pairs(int bodies) {
  return 0.5 * bodies * (bodies - 1);
}

/// The pairs of 5000 take a gigabyte in Bullet's own cache; their contacts would take ten more.
TEST_P(OnePoint, BodiesWhoseContactsAreRefused) {
  const int bodies = size_of_run(5000, 1000);
  const std::int64_t before = heap_watch::live_bytes();
  heap_watch::reset_peak();
  PlainWorld world(GetParam());
  world.dispatcher.setNearCallback([](btBroadphasePair&, btCollisionDispatcher&, const btDispatcherInfo&) {});
  meet(world, bodies);
  int least = world.broadphase->getOverlappingPairCache()->getNumOverlappingPairs();
  for (int i = 0; i < 2; ++i) {
    world.step();
    least = world.broadphase->getOverlappingPairCache()->getNumOverlappingPairs();
    EXPECT_EQ(least, all_pairs(bodies)) << "step " << i + 1;
  }
  const double gigabytes = static_cast<double>(heap_watch::peak_bytes() - before) / 1e9;
  judge("at one point, no contacts", "pairs missed == 0", GetParam(), all_pairs(bodies) - least,
        least == all_pairs(bodies), Asked::of_all, size_name(bodies));
  judge("at one point, no contacts", "memory at most, GB <= 2", GetParam(), gigabytes, gigabytes <= 2, Asked::of_all,
        size_name(bodies));
  world.end_all_pairs();
}

TEST_P(OnePoint, BodiesThatTouch) {
  const int bodies = size_of_run(1500, 200);
  PlainWorld world(GetParam());
  meet(world, bodies);
  world.step();
  EXPECT_EQ(world.dispatcher.getNumManifolds(), all_pairs(bodies));
  std::size_t missed = world.missed_pairs();
  for (int i = 0; i < 5; ++i) {
    world.step();
    missed += world.missed_pairs();
  }
  judge("at one point, with contacts", "pairs missed == 0", GetParam(), static_cast<double>(missed), missed == 0,
        Asked::of_all, size_name(bodies));
  judge("at one point, with contacts", "finite == 1", GetParam(), world.is_finite(), world.is_finite(), Asked::of_all,
        size_name(bodies));
  world.end_all_pairs();
}

}  // namespace
}  // namespace boxstream::worlds_test
