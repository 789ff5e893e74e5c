// SPDX-License-Identifier: MIT
#include "gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "ask_ccd.hpp"
#include "sanitized.hpp"

namespace boxstream::poses {
namespace {

constexpr unsigned seeds = tests::sanitized ? 3 : 10;

/// The poses are what they are meant to be, or the test below would show nothing.
TEST(Gaps, AreWhatTheyAimAt) {
  for (int family = 0; family < families; ++family)
    for (const double gap : gaps)
      for (unsigned seed = 0; seed < seeds; ++seed) {
        const double truth = gap_pose(static_cast<Family>(family), gap, seed).truth;
        EXPECT_GE(truth, gap - 4e-15) << family << ", seed " << seed;
        // A corner that is pushed into another may be out again after less than the push.
        if (gap > -1e-14) {
          EXPECT_LE(truth, gap + 4e-15) << family << ", seed " << seed;
        } else {
          EXPECT_LT(truth, gap / 10) << family << ", seed " << seed;
        }
      }
}

TEST(Gaps, OursIsRightOrSaysSo) {
  int right = 0, all = 0;
  for (int family = 0; family < families; ++family)
    for (const double gap : gaps)
      for (unsigned seed = 0; seed < seeds; ++seed) {
        const HardPose pose = gap_pose(static_cast<Family>(family), gap, seed);
        const Verdict verdict = ask_ccd(pose.a, pose.b);
        EXPECT_NE(verdict.kind, Verdict::Kind::wrong) << verdict.why << ": " << verdict.value << ", not " << pose.truth
                                                      << "; family " << family << ", seed " << seed;
        right += verdict.kind == Verdict::Kind::right;
        ++all;
      }
  EXPECT_GE(right, all * 99 / 100);
}

}  // namespace
}  // namespace boxstream::poses
