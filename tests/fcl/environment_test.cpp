// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment: which boxes touch does not depend on it.
#include <functional>

#include "core/box_sets.hpp"
#include "float_environment.hpp"
#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

using namespace tests;

template <class S>
struct Environment : ::testing::Test {};
TYPED_TEST_SUITE(Environment, Scalars);

template <class S>
using Frame = std::vector<FclBox<S>>;

/// Hard numbers, infinite, denormal and NaN ones among them, for each frame. Made in the default environment.
template <class S>
std::vector<Frame<S>> frames(std::size_t n) {
  std::vector<Frame<S>> all(4);
  for (std::size_t f = 0; f < all.size(); ++f)
    for (const char* name : {"ties", "denormals", "infinite", "invalid_among_valid", "full_range", "one_step_apart"})
      for (const auto& box : box_set<S>(name).make(n, f / 2))
        all[f].push_back(make_box<S>(box.min[0], box.min[1], box.min[2], box.max[0], box.max[1], box.max[2]));
  return all;
}

/// What every kind of collide query says in each frame, query by query.
template <class S>
std::vector<Calls> history(const std::vector<Frame<S>>& all) {
  std::vector<Calls> log;
  const auto third = static_cast<std::ptrdiff_t>(all[2].size() / 3);
  Scene<S> scene(all[0]), others(Frame<S>(all[2].begin(), all[2].begin() + third));
  Manager<S> manager, other;
  manager.registerObjects(scene.pointers());
  other.registerObjects(others.pointers());
  for (const Frame<S>& boxes : all) {
    for (std::size_t i = 0; i < boxes.size(); ++i) scene[i].set(boxes[i]);
    manager.update();
    log.push_back(collide<S>(manager));
    log.push_back(collide<S>(manager, other));
    for (std::size_t i = 0; i < boxes.size(); i += 7) log.push_back(collide<S>(manager, scene[i]));
  }
  return log;
}

/// Calls `compare(found, expected)` for each query.
template <class S, class Compare>
void compare_within(const std::function<void(const std::function<void()>&)>& environment, Compare compare) {
  for (const std::size_t n : {5, 60}) {
    const std::vector<Frame<S>> all = frames<S>(n);
    const std::vector<Calls> expected = history<S>(all);
    EXPECT_GT(expected[0].size(), n);
    std::vector<Calls> found;
    environment([&] { found = history<S>(all); });
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) compare(found[i], expected[i]);
  }
}

void expect_same(const Calls& found, const Calls& expected) {
  EXPECT_CALLS(found, expected);
}

TYPED_TEST(Environment, AnyRoundingMode) {
  for (const int mode : rounding_modes)
    compare_within<TypeParam>([=](const auto& work) { with_rounding(mode, work); }, expect_same);
}

#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
/// Few boxes are compared as FCL compares them, to which all denormal numbers are one then: none is missed, and some
/// that are apart by less than the smallest normal number are found as well.
TYPED_TEST(Environment, DenormalsFlushedToZero) {
  compare_within<TypeParam>(with_denormals_flushed, [](Calls found, Calls expected) {
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
    EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
  });
}
#endif

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
TYPED_TEST(Environment, FloatingPointExceptionsUnmasked) {
  compare_within<TypeParam>([](const auto& work) { with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, work); },
                            expect_same);
}
#endif

}  // namespace
}  // namespace boxstream::fcl_test
