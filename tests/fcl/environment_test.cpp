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

/// What every kind of collide query says in each frame.
template <class S>
Calls history(const std::vector<Frame<S>>& all) {
  Calls log;
  const auto add = [&](const Calls& calls) { log.insert(log.end(), calls.begin(), calls.end()); };
  Scene<S> scene(all[0]),
      others(Frame<S>(all[2].begin(), all[2].begin() + static_cast<std::ptrdiff_t>(all[2].size() / 3)));
  Manager<S> manager, other;
  manager.registerObjects(scene.pointers());
  other.registerObjects(others.pointers());
  for (const Frame<S>& boxes : all) {
    for (std::size_t i = 0; i < boxes.size(); ++i) scene[i].set(boxes[i]);
    manager.update();
    add(collide<S>(manager));
    add(collide<S>(manager, other));
    for (std::size_t i = 0; i < boxes.size(); i += 7) add(collide<S>(manager, scene[i]));
  }
  return log;
}

template <class S>
void expect_same_within(const std::function<void(const std::function<void()>&)>& environment) {
  for (const std::size_t n : {5, 60}) {
    const std::vector<Frame<S>> all = frames<S>(n);
    const Calls expected = history<S>(all);
    EXPECT_GT(expected.size(), 200u);
    Calls found;
    environment([&] { found = history<S>(all); });
    EXPECT_CALLS(found, expected);
  }
}

TYPED_TEST(Environment, AnyRoundingMode) {
  for (const int mode : rounding_modes)
    expect_same_within<TypeParam>([=](const auto& work) { with_rounding(mode, work); });
}

#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
TYPED_TEST(Environment, DenormalsFlushedToZero) {
  expect_same_within<TypeParam>(with_denormals_flushed);
}
#endif

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
TYPED_TEST(Environment, FloatingPointExceptionsUnmasked) {
  expect_same_within<TypeParam>([](const auto& work) { with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, work); });
}
#endif

}  // namespace
}  // namespace boxstream::fcl_test
