// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment: pairs and box queries do not depend on it.
#include <gtest/gtest.h>

#include <functional>
#include <vector>

#include "core/box_sets.hpp"
#include "float_environment.hpp"
#include "support.hpp"

namespace bullet_tests {
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
std::vector<int> history(const std::vector<Frame>& all, bool borrowed) {
  std::vector<int> log;
  btHashedOverlappingPairCache cache;
  Rig rig(Kind::subject, borrowed ? &cache : nullptr);
  const auto to_box = [](const boxstream::BasicAabb<btScalar>& box) -> Box {
    return {btVector3(box.min[0], box.min[1], box.min[2]), btVector3(box.max[0], box.max[1], box.max[2])};
  };
  std::vector<btBroadphaseProxy*> proxies;
  for (const auto& box : all[0]) proxies.push_back(rig.create(to_box(box)));
  for (const Frame& boxes : all) {
    for (std::size_t i = 0; i < boxes.size(); ++i) rig.move(proxies[i], to_box(boxes[i]));
    rig.calculate();
    for (const auto& [a, b] : sorted(rig.pairs())) log.insert(log.end(), {a, b});
    for (std::size_t i = 0; i < boxes.size(); i += 5) {
      std::vector<int> found;
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

TEST(BulletEnvironment, AnyRoundingMode) {
  for (const int mode : rounding_modes) expect_same_within([=](const auto& work) { with_rounding(mode, work); });
}

#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
TEST(BulletEnvironment, DenormalsFlushedToZero) {
  expect_same_within(with_denormals_flushed);
}
#endif

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
TEST(BulletEnvironment, FloatingPointExceptionsUnmasked) {
  expect_same_within([](const auto& work) { with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, work); });
}
#endif

}  // namespace
}  // namespace bullet_tests
