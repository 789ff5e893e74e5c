// SPDX-License-Identifier: MIT
// Hosts that change the floating-point environment, or have little stack.
#include <cfenv>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif
#if defined(__unix__)
#include <pthread.h>
#endif

#include "box_sets.hpp"
#include "executors.hpp"
#include "search_record.hpp"

namespace boxstream::tests {
namespace {

/// Searches of all box sets, done once in the default environment and once in another.
template <class S>
class Environment : public testing::Test {
 protected:
  /// `enter` is called right before each batch of searches and `leave` right after; nothing else runs in between.
  void expect_same_within(const std::function<void()>& enter, const std::function<void()>& leave) {
    std::fenv_t before;
    std::fegetenv(&before);
    InlineExecutor two(2);
    for (const auto& set : box_sets<S>()) {
      SCOPED_TRACE(set.name);
      const auto a = set.make(std::min<std::size_t>(17000, set.largest), 1), b = set.make(300, 2);
      const auto few = set.make(40, 3);
      Detector serial, parallel(DetectorOptions{&two});
      const auto expected = search_all<S>(serial, a, b), expected_few = search_all<S>(serial, few, b);
      SearchRecord found, found_few, found_parallel;
      enter();
      found = search_all<S>(serial, a, b);
      found_few = search_all<S>(serial, few, b);
      found_parallel = search_all<S>(parallel, a, b);
      leave();
      std::fesetenv(&before);
      expect_same_search(found, expected);
      expect_same_search(found_few, expected_few);
      expect_same_search(found_parallel, expected);
      if (this->HasFailure()) return;
    }
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Environment, Scalars);

#if defined(__SSE2__)
TYPED_TEST(Environment, DenormalsFlushedToZero) {
  constexpr unsigned flush_to_zero = 0x8000, denormals_are_zero = 0x0040;
  const unsigned before = _mm_getcsr();
  this->expect_same_within([=] { _mm_setcsr(before | flush_to_zero | denormals_are_zero); },
                           [=] { _mm_setcsr(before); });
}
#endif

TYPED_TEST(Environment, AnyRoundingMode) {
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    SCOPED_TRACE("rounding mode " + std::to_string(mode));
    this->expect_same_within([=] { std::fesetround(mode); }, [] { std::fesetround(FE_TONEAREST); });
  }
}

#if defined(__GLIBC__) && defined(__x86_64__)
/// A trap kills this process, so that the test fails by that. Finite, infinite and NaN boxes are among the sets. Even
/// rounding traps: plans are made of rounded numbers, but not in the caller's environment.
TYPED_TEST(Environment, FloatingPointExceptionsUnmasked) {
  this->expect_same_within(
      [] {
        std::feclearexcept(FE_ALL_EXCEPT);
        feenableexcept(FE_ALL_EXCEPT);
      },
      [] {
        fedisableexcept(FE_ALL_EXCEPT);
        std::feclearexcept(FE_ALL_EXCEPT);
      });
}
#endif

#if defined(__unix__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
/// Runs `work` in a thread with a stack of 64 KiB.
void on_small_stack(std::function<void()> work) {
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 65536), 0);
  pthread_t thread;
  const auto start = [](void* argument) -> void* {
    (*static_cast<std::function<void()>*>(argument))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, start, &work), 0);
  ASSERT_EQ(pthread_join(thread, nullptr), 0);
  pthread_attr_destroy(&attributes);
}

TYPED_TEST(Environment, SmallStack) {
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)})
    for (const auto& set : box_sets<TypeParam>()) {
      SCOPED_TRACE(set.name);
      const auto a = set.make(std::min<std::size_t>(17000, set.largest), 1), b = set.make(300, 2);
      Detector detector(DetectorOptions{executor});
      const auto expected = search_all<TypeParam>(detector, a, b);
      SearchRecord found;
      on_small_stack([&] { found = search_all<TypeParam>(detector, a, b); });
      expect_same_search(found, expected);
    }
}
#endif

}  // namespace
}  // namespace boxstream::tests
