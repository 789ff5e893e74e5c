// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment, or have little stack.
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "executors.hpp"
#include "float_environment.hpp"
#include "search_record.hpp"
#include "small_stack.hpp"

namespace boxstream::tests {
namespace {

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
