// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace {

// The first must fail, for it asserts nothing, and the others pass: see CMakeLists.txt.

TEST(Vacuous, LoopsOverNothing) {
  for (int i = 0; i < 0; ++i) EXPECT_EQ(i, i);
}

TEST(Vacuous, AssertsInGoogleTest) {
  EXPECT_EQ(1 + 1, 2);
}

TEST(Vacuous, AssertsInRapidCheck) {
  const bool holds = rc::check([] { RC_ASSERT(1 + 1 == 2); });
  if (!holds) FAIL();
}

TEST(Vacuous, IsSkipped) {
  GTEST_SKIP() << "a skipped test is told as such";
}

}  // namespace
