// SPDX-License-Identifier: MIT
// Steps of a microsecond, of half a second, of no length, and of all lengths in turn.
#include <string>
#include <vector>

#include "judge.hpp"
#include "sizes.hpp"

namespace boxstream::worlds_test {
namespace {

const btScalar half = btScalar(0.5);

class Times : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Times, testing::ValuesIn(kinds), [](const auto& test) { return test_name(test.param); });

void pile_up(PlainWorld& world) {
  world.add_ground();
  auto* cube = world.shape<btBoxShape>(btVector3(half, half, half));
  for (int i = 0; i < 12; ++i)
    world.add(1, cube, btVector3(btScalar(i % 3) * btScalar(0.9), half + btScalar(i / 3) * btScalar(0.98), 0));
}

struct Lengths {
  const char* world;
  std::vector<double> of_steps;  ///< in turn
  int steps;
};

TEST_P(Times, LeaveAFiniteWorldAndNoPairs) {
  for (const Lengths& lengths : {Lengths{"steps of 1e-6 s", {1e-6}, 600}, Lengths{"steps of 0.5 s", {0.5}, 300},
                                 Lengths{"steps of 0 s", {0}, 60},
                                 Lengths{"steps of 1e-6 to 0.5 s", {1e-6, 1.0 / 60, 0.5, 0, 1.0 / 240, 0.1}, 600}}) {
    PlainWorld world(GetParam(), Room{btVector3(0, 0, 0), 1000, 100});
    pile_up(world);
    std::size_t missed = 0;
    bool finite = true;
    const int steps = size_of_run(lengths.steps, lengths.steps);
    for (int i = 0; i < steps; ++i) {
      world.step(btScalar(lengths.of_steps[static_cast<std::size_t>(i) % lengths.of_steps.size()]));
      // Bullet takes a step of no length for none: nothing is looked for.
      if (lengths.of_steps != std::vector<double>{0}) missed += world.missed_pairs();
      finite = finite && world.is_finite();
    }
    judge(lengths.world, "finite == 1", GetParam(), finite, finite);
    judge(lengths.world, "pairs missed == 0", GetParam(), static_cast<double>(missed), missed == 0);
    world.clear();
    const int left = world.broadphase->getOverlappingPairCache()->getNumOverlappingPairs();
    const long leaked = world.dispatcher.allocated - world.dispatcher.freed;
    judge(lengths.world, "pairs left in the empty world == 0", GetParam(), left, left == 0);
    judge(lengths.world, "contact algorithms left in the empty world == 0", GetParam(), static_cast<double>(leaked),
          leaked == 0);
  }
}

TEST_P(Times, AStepOfNoLengthChangesNothing) {
  PlainWorld world(GetParam()), without(GetParam());
  pile_up(world);
  pile_up(without);
  int differing = 0;
  for (int i = 0; i < 120; ++i) {
    world.step();
    without.step();
    const std::uint64_t before = world.state_hash();
    for (int k = 0; k < i % 3; ++k) world.step(0);
    differing += world.state_hash() != before || before != without.state_hash();
  }
  judge("steps of 0 s among others", "steps that differ from a world without them == 0", GetParam(), differing,
        differing == 0);
}

}  // namespace
}  // namespace boxstream::worlds_test
