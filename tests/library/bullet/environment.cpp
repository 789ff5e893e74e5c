// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment: pairs and box queries do not depend on it.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include <boxstream/bullet.hpp>
#include <boxstream/detail/float_environment.hpp>

#include "core/box_sets.hpp"
#include "float_environment.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

using namespace boxstream::tests;

using Frame = Boxes<btScalar>;

/// Hard numbers, infinite, denormal and invalid boxes among them, for each frame. Made in the default environment.
std::vector<Frame> frames() {
  std::vector<Frame> all(4);
  for (std::size_t f = 0; f < all.size(); ++f)
    for (const char* name : {"ties", "denormals", "infinite", "invalid_among_valid", "full_range", "one_step_apart"}) {
      const auto boxes = box_set<btScalar>(name).make(60, f / 2);  // at rest in every other frame
      all[f].insert(all[f].end(), boxes.begin(), boxes.end());
    }
  return all;
}

/// Unique ids of the pairs, and of what queries find, of a run through the frames.
std::vector<int> history(
    const std::vector<Frame>& all, bool borrowed, const std::function<unsigned()>& mood = [] { return 0u; }) {
  std::vector<int> log;
  btHashedOverlappingPairCache cache;
  Rig rig(Kind::subject, borrowed ? &cache : nullptr);
  const auto to_box = [](const boxstream::BasicAabb<btScalar>& box) -> Box {
    return {btVector3(box.min[0], box.min[1], box.min[2]), btVector3(box.max[0], box.max[1], box.max[2])};
  };
  std::vector<btBroadphaseProxy*> proxies;
  for (const auto& box : all[0]) proxies.push_back(rig.create(to_box(box)));
  for (const Frame& boxes : all) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Mood now(mood());
      rig.move(proxies[i], to_box(boxes[i]));
    }
    {
      const Mood now(mood());
      rig.calculate();
    }
    for (const auto& [a, b] : sorted(rig.pairs())) log.insert(log.end(), {a, b});
    for (std::size_t i = 0; i < boxes.size(); i += 5) {
      std::vector<int> found;
      const Mood now(mood());
      for (const btBroadphaseProxy* proxy : rig.in_box(to_box(boxes[i]))) found.push_back(proxy->m_uniqueId);
      for (const int id : sorted(found)) log.push_back(id);
    }
    log.push_back(-1);
  }
  return log;
}

void expect_same_within(const std::function<void(const std::function<void()>&)>& environment) {
  const std::vector<Frame> all = frames();
  for (const bool borrowed : {false, true}) {
    const std::vector<int> expected = history(all, borrowed);
    EXPECT_GT(expected.size(), 5000u);
    std::vector<int> found;
    environment([&] { found = history(all, borrowed); });
    EXPECT_TRUE(found == expected) << (borrowed ? "borrowed cache" : "own cache");
  }
}

/// Each frame in an environment of its own: the index that one query refits is used by the next.
TEST(BulletEnvironment, SwitchedFromCallToCall) {
  const std::vector<Frame> all = frames();
  for (const bool borrowed : {false, true}) {
    const std::vector<int> expected = history(all, borrowed);
    for (unsigned seed = 0; seed < 5; ++seed) {
      Random random(seed);
      EXPECT_TRUE(history(all, borrowed, [&] { return static_cast<unsigned>(random.below(Mood::count)); }) == expected)
          << seed;
    }
  }
}

TEST(BulletEnvironment, AnyRoundingMode) {
  for (const int mode : rounding_modes) expect_same_within([=](const auto& work) { with_rounding(mode, work); });
}

#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
TEST(BulletEnvironment, DenormalsFlushedToZero) {
  expect_same_within(with_denormals_flushed);
}
#endif

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
struct Counter : btBroadphaseRayCallback {
  bool process(const btBroadphaseProxy*) override { return ++count > 0; }
  unsigned count = 0;
};

/// Every call with a special value at every place; what was counted.
unsigned call_all(btScalar margin, boxstream::bullet::Eager eager, const std::vector<btScalar>& special_values) {
  Counter counter;
  boxstream::bullet::Options options;
  options.margin = margin;
  options.eager = eager;
  boxstream::bullet::Broadphase broadphase(options);
  std::vector<btBroadphaseProxy*> proxies;
  const auto vector = [](const btScalar* x) { return btVector3(x[0], x[1], x[2]); };
  for (int i = 0; i < 120; ++i)
    proxies.push_back(broadphase.createProxy(btVector3(btScalar(i), 0, 0), btVector3(btScalar(i + 1), 1, 1), 0, nullptr,
                                             1, -1, nullptr));
  for (const btScalar& special : special_values)
    for (unsigned place = 0; place < 6; ++place) {
      btScalar x[6] = {1, 1, 1, 2, 2, 2};
      x[place] = special;
      const btVector3 low = vector(x), high = vector(x + 3), both[2] = {low, high};
      for (unsigned again = 0; again < 3; ++again) {
        broadphase.setAabb(proxies[place], low, high, nullptr);
        broadphase.setAabb(proxies[50 + again], high, low, nullptr);
        broadphase.calculateOverlappingPairs(nullptr);
      }
      counter.count += static_cast<unsigned>(broadphase.getOverlappingPairCache()->getNumOverlappingPairs());
      broadphase.aabbTest(low, high, counter);
      for (const bool backwards : {false, true}) {
        counter.m_rayDirectionInverse = backwards ? high : vector(x);
        counter.m_lambda_max = backwards ? special : btScalar(5);
        {
          const boxstream::detail::DefaultFloatEnvironment environment;
          for (unsigned d = 0; d < 3; ++d) counter.m_signs[d] = counter.m_rayDirectionInverse[int(d)] < 0 ? 1 : 0;
        }
        broadphase.rayTest(low, high, counter, btVector3(0, 0, 0), btVector3(0, 0, 0));
        broadphase.rayTest(btVector3(0, 0, 0), high, counter, low, high);
      }
      const btScalar offsets[2] = {special, 1};
      broadphase.planesTest(both, offsets, 2, counter);
      btVector3 lower, upper;
      broadphase.getBroadphaseAabb(lower, upper);
      broadphase.getAabb(proxies[place], lower, upper);
      btBroadphaseProxy* const made = broadphase.createProxy(low, high, 0, nullptr, 1, -1, nullptr);
      broadphase.calculateOverlappingPairs(nullptr);
      broadphase.destroyProxy(made, nullptr);
    }
  for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  return counter.count;
}

TEST(BulletEnvironment, NoCallTrapsForAnySpecialValue) {
  using Limits = std::numeric_limits<btScalar>;
  const std::vector<btScalar> special_values = {0,
                                                -btScalar(0),
                                                Limits::denorm_min(),
                                                -Limits::denorm_min(),
                                                btScalar(1e18),
                                                btScalar(-1e30),
                                                Limits::max(),
                                                -Limits::max(),
                                                Limits::infinity(),
                                                -Limits::infinity(),
                                                Limits::quiet_NaN(),
                                                Limits::signaling_NaN()};
  using boxstream::bullet::Eager;
  for (const Eager eager : {Eager::ghosts, Eager::all})
    for (const btScalar margin : special_values) {
      const unsigned expected = call_all(margin, eager, special_values);
      EXPECT_GT(expected, 1000u);
      unsigned found = 0;
      with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, [&] { found = call_all(margin, eager, special_values); });
      EXPECT_EQ(found, expected) << "margin " << margin << (eager == Eager::all ? ", all eager" : "");
    }
}

TEST(BulletEnvironment, FloatingPointExceptionsUnmasked) {
  expect_same_within([](const auto& work) { with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, work); });
}
#endif

}  // namespace
}  // namespace boxstream::bullet_test
