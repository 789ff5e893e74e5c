// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <boxstream/object_set.hpp>

#include <cfenv>
#include <functional>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "float_environment.hpp"

namespace boxstream {
namespace {

/// Boxes with special numbers among their bounds.
template <class S>
std::vector<BasicAabb<S>> special_boxes(std::mt19937& random, std::size_t count) {
  using Limits = std::numeric_limits<S>;
  const S numbers[] = {0,
                       -S(0),
                       1,
                       2,
                       Limits::denorm_min(),
                       3 * Limits::denorm_min(),
                       -Limits::denorm_min(),
                       Limits::max(),
                       -Limits::max(),
                       Limits::infinity(),
                       -Limits::infinity(),
                       Limits::quiet_NaN()};
  std::vector<BasicAabb<S>> boxes(count);
  for (BasicAabb<S>& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = numbers[random() % 9];
      box.max[d] = numbers[random() % 9];
      if (box.max[d] < box.min[d]) std::swap(box.min[d], box.max[d]);
      if (random() % 16 == 0) box.max[d] = numbers[9 + random() % 3];
    }
  return boxes;
}

/// What all queries visit, one after the other, and the limits that were passed to them.
template <class S>
std::vector<std::pair<std::uint32_t, std::uint32_t>> ask(const std::vector<BasicAabb<S>>& boxes,
                                                         const std::vector<BasicAabb<S>>& others) {
  using Set = BasicObjectSet<S>;
  Set set, other;
  std::vector<int> objects(boxes.size() + others.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) set.add(&objects[i], boxes[i], {}, false);
  for (std::size_t i = 0; i < others.size(); ++i) other.add(&objects[boxes.size() + i], others[i], {}, false);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> visited;
  constexpr S no_limit = std::numeric_limits<S>::infinity();
  const auto pair = [&](std::uint32_t a, std::uint32_t b) {
    visited.emplace_back(a, b);
    return true;
  };
  const auto near_pair = [&](std::uint32_t a, std::uint32_t b) {
    visited.emplace_back(a, b);
    return no_limit;
  };
  for (int again = 0; again < 2; ++again) {
    for (const BasicAabb<S>& box : others) {
      set.for_each_overlap(box, {}, Set::Order::any, [&](std::uint32_t place) { return pair(place, 100); });
      set.for_each_near(box, {}, no_limit, [&](std::uint32_t place) { return near_pair(place, 200); });
    }
    set.for_each_pair(pair);
    set.for_each_pair(other, Set::Order::any, pair);
    set.for_each_near_pair(no_limit, near_pair);
    set.for_each_near_pair(other, no_limit, near_pair);
  }
  return visited;
}

template <class S>
class FewObjects : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(FewObjects, Scalars);

/// Neither rounding, nor flushing to zero, nor traps of the caller change what is found, or its order.
TYPED_TEST(FewObjects, AnyFloatingPointEnvironment) {
  using S = TypeParam;
  std::mt19937 random(7);
  std::size_t found = 0;
  for (int round = 0; round < 400; ++round) {
    const auto boxes = special_boxes<S>(random, 1 + random() % 8), others = special_boxes<S>(random, 1 + random() % 8);
    const auto expected = ask(boxes, others);
    found += expected.size();
    std::function<void()> compare = [&] { EXPECT_EQ(ask(boxes, others), expected) << round; };
    for (const int mode : tests::rounding_modes) tests::with_rounding(mode, compare);
#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
    tests::with_denormals_flushed(compare);
#endif
#if defined(BOXSTREAM_TESTS_CAN_TRAP)
    std::vector<std::pair<std::uint32_t, std::uint32_t>> trapped;
    tests::with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, [&] { trapped = ask(boxes, others); });
    EXPECT_EQ(trapped, expected) << round;
#endif
    if (this->HasFailure()) return;
  }
  EXPECT_GT(found, 10000u);
}

}  // namespace
}  // namespace boxstream
