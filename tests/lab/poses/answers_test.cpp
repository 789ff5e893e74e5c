// SPDX-License-Identifier: MIT
// What narrow phases answer to hard poses: ours, and FCL's behind our manager.
#include <cmath>

#include "ask_ccd.hpp"
#include "every_pose.hpp"
#include "outcome.hpp"
#include "sanitized.hpp"
#include "truth.hpp"

namespace boxstream::poses {
namespace {

struct Answer : testing::TestWithParam<HardPose> {};

/// Right, or with a status that is not `ok` and bounds that hold.
TEST_P(Answer, OfOursIsRightOrSaysSo) {
  const HardPose& pose = GetParam();
  for (const auto solver : {ccd::Options::Solver::automatic, ccd::Options::Solver::gjk})
    for (const double tolerance : {1e-6, 1e-9, 1e-3}) {
      ccd::Options options;
      options.solver = solver;
      options.tolerance = tolerance;
      const bool is_default = solver == ccd::Options::Solver::automatic && tolerance == 1e-6;
      for (const bool swap : {false, true}) {
        const Verdict verdict = ask_ccd(swap ? pose.b : pose.a, swap ? pose.a : pose.b, options);
        SCOPED_TRACE(testing::Message() << "tolerance " << tolerance << ", solver " << static_cast<int>(solver)
                                        << (swap ? ", swapped: " : ": ") << verdict.why << ", " << verdict.value);
        EXPECT_NE(verdict.kind, Verdict::Kind::wrong) << name(verdict.kind);
        if (pose.a.kind == Kind::half_space) {
          EXPECT_EQ(verdict.kind, Verdict::Kind::no_such_shape);
        } else if (is_default) {
          EXPECT_EQ(verdict.kind, Verdict::Kind::right) << name(verdict.kind);
          EXPECT_NEAR(verdict.value, pose.truth, 1e-6 * std::min(radius(pose.a), radius(pose.b)));
        }
      }
    }
}

/// FCL's defects are known, and written into poses.json. When one of them is gone, or there is another, that file and
/// the table made of it (poses_table.py --record) want a look.
void expect_known(const HardPose& pose, Solver solver, const Known& known) {
  if (tests::sanitized) GTEST_SKIP() << "sanitizers end processes in ways of their own";
  const Outcome outcome = run(BOXSTREAM_POSE_PROBE, pose, Manager::boxstream, solver);
  EXPECT_EQ(outcome.delivered, 1);
  EXPECT_TRUE(outcome.in_order);
  // What does not end in five seconds may end in a little less on a faster machine, and is right then.
  const bool ends_late = known.outcome == "no end" && outcome.kind == "right";
  EXPECT_TRUE(outcome.kind == known.outcome || ends_late)
      << "FCL's answer is not the one that is known, " << known.outcome << ", but " << outcome.kind << ": "
      << outcome.message;
  if (std::isfinite(known.value)) {
    EXPECT_NEAR(outcome.value, known.value, 1e-6 * (1 + std::abs(known.value)));
  }
  const bool lives = outcome.kind == "right" || outcome.kind == "wrong" || outcome.kind == "throws";
  EXPECT_EQ(outcome.after, lives ? 1 : 0) << "calls in a later query of the same manager";
}

TEST_P(Answer, OfFclOnLibccdIsTheKnownOne) {
  expect_known(GetParam(), Solver::libccd, GetParam().libccd);
}
TEST_P(Answer, OfFclOnItsOwnSolverIsTheKnownOne) {
  expect_known(GetParam(), Solver::indep, GetParam().indep);
}

BOXSTREAM_FOR_EVERY_POSE(Answer);

}  // namespace
}  // namespace boxstream::poses
