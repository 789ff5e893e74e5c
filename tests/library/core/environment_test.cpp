// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment, or have little stack.
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include <boxstream/near.hpp>
#include <boxstream/ray.hpp>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "executors.hpp"
#include "float_environment.hpp"
#include "search_record.hpp"
#include "small_stack.hpp"

namespace boxstream::tests {
namespace {

/// The bits of a number, for comparing results that may be NaN.
template <class S>
std::uint64_t bits_of(S x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof(x));
  return x == x ? bits : ~std::uint64_t{0};
}

/// Searches of all box sets, done once in the default environment and once in another.
template <class S>
class Environment : public testing::Test {
 protected:
  /// `environment(work)` runs nothing but the searches.
  void expect_same_within(const std::function<void(const std::function<void()>&)>& environment) {
    InlineExecutor two(2);
    for (const auto& set : box_sets_to_repeat<S>()) {
      SCOPED_TRACE(set.name);
      const auto a = set.make(std::min<std::size_t>(17000, set.largest), 1), b = set.make(300, 2);
      const auto few = set.make(40, 3);
      Detector serial, parallel(DetectorOptions{&two});
      const auto expected = search_all<S>(serial, a, b), expected_few = search_all<S>(serial, few, b);
      SearchRecord found, found_few, found_parallel;
      environment([&] {
        found = search_all<S>(serial, a, b);
        found_few = search_all<S>(serial, few, b);
        found_parallel = search_all<S>(parallel, a, b);
      });
      expect_same_search(found, expected);
      expect_same_search(found_few, expected_few);
      expect_same_search(found_parallel, expected);
      if (this->HasFailure()) return;
    }
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Environment, Scalars);

#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
TYPED_TEST(Environment, DenormalsFlushedToZero) {
  this->expect_same_within(with_denormals_flushed);
}
#endif

#if defined(BOXSTREAM_TESTS_CAN_FLUSH_DENORMALS)
/// A tolerance is a number to the search, whatever the host takes it for.
TEST(EnvironmentOfRules, SubnormalTolerancesAreSome) {
  const std::vector<Aabb64> boxes{{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {2, 1, 1}}};
  PairRules rules;
  rules.touching = false;
  rules.tolerance = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(find_pairs(boxes, rules).size(), 1u);
  std::vector<Pair> found;
  with_denormals_flushed([&] { found = find_pairs(boxes, rules); });
  EXPECT_EQ(found.size(), 1u);
}
#endif

TYPED_TEST(Environment, AnyRoundingMode) {
  for (const int mode : rounding_modes) {
    SCOPED_TRACE("rounding mode " + std::to_string(mode));
    this->expect_same_within([=](const auto& work) { with_rounding(mode, work); });
  }
}

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
/// Finite, infinite and NaN boxes are among the sets. Even rounding traps: plans are made of rounded numbers, but not
/// in the caller's environment.
TYPED_TEST(Environment, FloatingPointExceptionsUnmasked) {
  this->expect_same_within([](const auto& work) { with_traps(FE_ALL_EXCEPT, work); });
}
#endif

#if defined(BOXSTREAM_TESTS_CAN_TRAP)
/// What headers compute inline, and balls, of every special value at every place.
template <class S>
std::vector<std::uint64_t> helpers_of(const std::vector<S>& values, const std::vector<BasicBall<S>>& balls) {
  std::vector<std::uint64_t> log;
  const auto note = [&](S x) { log.push_back(bits_of(x)); };
  for (const S x : values)
    for (const S y : values)
      for (int place = 0; place < 3; ++place) {
        BasicAabb<S> box{{0, 0, 0}, {1, 1, 1}};
        box.min[place] = x;
        box.max[place] = y;
        log.push_back(is_valid(box));
        log.push_back(box == box);
        S direction[3] = {1, 0, -1};
        direction[place] = x;
        for (const S inverse : BasicRay<S>::along(box.min, direction, y).inverse_direction) note(inverse);
        for (const S inverse : BasicRay<S>::sweep(box, direction).inverse_direction) note(inverse);
        if (!is_valid(box) || !(y == y)) continue;
        const auto grown = expanded(box, values[log.size() % values.size()]);
        note(grown.min[place]);
        note(grown.max[place]);
        note(merged(box, grown).min[place]);
        log.push_back(overlaps(box, grown));
      }
  Detector detector;
  std::vector<Pair> pairs;
  std::vector<double> distances{0.1, 0x1p509, std::numeric_limits<double>::max()};  // of doubles, for floats too
  distances.insert(distances.end(), values.begin(), values.end());
  for (const double distance : distances) {
    if (!(std::isfinite(distance) && !std::signbit(distance))) continue;
    find_near_pairs(detector, Span<const BasicBall<S>>(balls), distance, pairs);
    for (const Pair p : pairs) {
      log.push_back(p.a * balls.size() + p.b);
      log.push_back(is_near(balls[p.a], balls[p.b], distance));
    }
  }
  return log;
}

TYPED_TEST(Environment, HelpersAndBallsUnderTraps) {
  using S = TypeParam;
  using Limits = std::numeric_limits<S>;
  const std::vector<S> values = {0,
                                 -S(0),
                                 Limits::denorm_min(),
                                 -Limits::denorm_min(),
                                 Limits::min() / 4,
                                 Limits::min(),
                                 1,
                                 S(-1e30),
                                 Limits::max() / 4,
                                 Limits::max(),
                                 -Limits::max(),
                                 Limits::infinity(),
                                 -Limits::infinity(),
                                 Limits::quiet_NaN()};
  std::vector<BasicBall<S>> balls;
  for (const S x : values)
    for (const S radius : values)
      for (std::size_t place = 0; place < 3; ++place) {
        balls.push_back({{1, 1, 1}, radius});
        balls.back().centre[place] = x;
      }
  const auto expected = helpers_of(values, balls);
  EXPECT_GT(expected.size(), 10000u);
  std::vector<std::uint64_t> found;
  with_traps(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW, [&] { found = helpers_of(values, balls); });
  EXPECT_TRUE(found == expected);

  // Which balls are near does not depend on the environment at all.
  Detector detector;
  for (const S value : {S(0), Limits::denorm_min(), Limits::max() / 4}) {
    const volatile double distance = value;  // here, for some environments take a denormal float for zero
    std::vector<Pair> pairs;
    find_near_pairs(detector, Span<const BasicBall<S>>(balls), distance, pairs);
    for (unsigned number = 0; number < Mood::count; ++number) {
      std::vector<Pair> in_mood;
      {
        const Mood mood(number);
        find_near_pairs(detector, Span<const BasicBall<S>>(balls), distance, in_mood);
      }
      EXPECT_TRUE(in_mood == pairs) << "environment " << number;
    }
  }
}
#endif

TYPED_TEST(Environment, SmallStack) {
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)})
    for (const auto& set : box_sets_to_repeat<TypeParam>()) {
      SCOPED_TRACE(set.name);
      const auto a = set.make(std::min<std::size_t>(17000, set.largest), 1), b = set.make(300, 2);
      Detector detector(DetectorOptions{executor});
      const auto expected = search_all<TypeParam>(detector, a, b);
      SearchRecord found;
      on_small_stack([&] { found = search_all<TypeParam>(detector, a, b); });
      expect_same_search(found, expected);
    }
}

}  // namespace
}  // namespace boxstream::tests
