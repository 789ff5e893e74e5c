// SPDX-License-Identifier: MIT
// Bodies come and go in every step, thousands of times, and memory stays where it was.
#include <LinearMath/btAlignedAllocator.h>

#include <new>
#include <string>

#include "heap_watch.hpp"
#include "judge.hpp"
#include "sizes.hpp"

namespace boxstream::worlds_test {
namespace {

namespace heap_watch = boxstream::tests::heap_watch;

// Before main, so that all that Bullet allocates is seen by the watch.
[[maybe_unused]] const bool watched = [] {
  btAlignedAllocSetCustom([](std::size_t size) { return ::operator new(size); },
                          [](void* memory) { ::operator delete(memory); });
  return true;
}();

class Births : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, Births, testing::ValuesIn(kinds), [](const auto& test) { return test_name(test.param); });

TEST_P(Births, MemoryStaysFlatAndPairsRight) {
  const int at_once = whole_runs() ? 1000 : 25, population = whole_runs() ? 4000 : 400;
  if (whole_runs() && GetParam() == Kind::simple) GTEST_SKIP() << "quadratic time, ten thousand times";
  // Bullet's own go through all pairs for each body that goes.
  const int steps = size_of_run(GetParam() == Kind::subject ? 10000 : 1000, 240), look_every = whole_runs() ? 100 : 20;
  const auto spread = btScalar(whole_runs() ? 20 : 6.5);
  PlainWorld world(GetParam());
  world.add(0, world.shape<btBoxShape>(btVector3(30, 1, 30)), btVector3(0, -1, 0));
  btCollisionShape* const kinds_of_drops[] = {
      world.shape<btSphereShape>(btScalar(0.3)),
      world.shape<btBoxShape>(btVector3(btScalar(0.3), btScalar(0.3), btScalar(0.3)))};
  Random random(17);
  const auto rain = [&](int count) {
    for (int i = 0; i < count; ++i) {
      const btVector3 place(random.real(-spread, spread), random.real(btScalar(0.5), 4), random.real(-spread, spread));
      world.add(1, kinds_of_drops[i % 2], place);
    }
  };
  rain(population);
  std::int64_t most_before = 0, most_after = 0;
  double seen = 0;
  int looked = 0, wrong = 0;
  for (int step = 0; step < steps; ++step) {
    for (int i = 0; i < at_once; ++i)
      world.remove(1 + static_cast<std::size_t>(random.below(static_cast<int>(world.bodies.size()) - 1)));
    rain(at_once);
    world.step();
    std::int64_t& most = step < steps / 2 ? most_before : most_after;
    most = std::max(most, heap_watch::live_bytes());
    if (step % look_every != 0) continue;
    const testing::AssertionResult right = world.check_pairs();
    EXPECT_TRUE(right) << "step " << step + 1;
    wrong += !right;
    ++looked;
    seen += static_cast<double>(world.held_pairs().size());
  }
  EXPECT_GT(seen / looked, population / 4);  // else there is nothing to be wrong about
  const double growth = static_cast<double>(most_after) / static_cast<double>(most_before);
  const std::string size = ", " + std::to_string(at_once) + " of " + std::to_string(population) + " in each of " +
                           std::to_string(whole_runs() ? 10000 : steps) + " steps";
  judge("come and go", "memory of the second half over that of the first <= 1.05", GetParam(), growth, growth <= 1.05,
        Asked::of_all, size);
  judge("come and go", "times that pairs were wrong == 0", GetParam(), wrong, wrong == 0, Asked::of_all, size);
}

}  // namespace
}  // namespace boxstream::worlds_test
