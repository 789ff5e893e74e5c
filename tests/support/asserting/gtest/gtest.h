// SPDX-License-Identifier: MIT
// Stands before GoogleTest's own header on the include path of all tests, and makes a test that passes without having
// asserted anything a failure: one that loops over nothing, or returns before it comes to the point.
#pragma once
#pragma GCC system_header  // for #include_next

#include_next <gtest/gtest.h>

#include <atomic>

namespace boxstream::tests {

/// Whether the test that runs has come to an assertion, on any thread.
inline std::atomic<bool> has_asserted{false};

inline int note_assertion() {
  has_asserted.store(true, std::memory_order_relaxed);
  return 0;
}

class AssertionWatch final : public testing::EmptyTestEventListener {
  void OnTestStart(const testing::TestInfo&) override { has_asserted = false; }
  void OnTestEnd(const testing::TestInfo& test) override {
    if (!has_asserted && test.result()->Passed()) ADD_FAILURE() << "passed without asserting anything";
  }
};

inline const bool watches_assertions = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new AssertionWatch);
  return true;
}();

}  // namespace boxstream::tests

// All of EXPECT_... and ASSERT_... begin with this, failed or not; ADD_FAILURE, FAIL and SUCCEED do not.
#undef GTEST_AMBIGUOUS_ELSE_BLOCKER_
#define GTEST_AMBIGUOUS_ELSE_BLOCKER_           \
  switch (::boxstream::tests::note_assertion()) \
  case 0:                                       \
  default:
