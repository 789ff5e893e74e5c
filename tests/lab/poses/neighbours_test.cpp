// SPDX-License-Identifier: MIT
// Hard poses moved and turned a little, where solvers fail next: ours must be right or say that it is not.
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

#include "ask_ccd.hpp"
#include "every_pose.hpp"
#include "sanitized.hpp"
#include "truth.hpp"

namespace boxstream::poses {
namespace {

constexpr int most_variants = tests::sanitized ? 5 : 40;

class Nudge {
 public:
  explicit Nudge(std::uint32_t seed) : random_(seed) {}

  /// A few units in the last place of each coordinate.
  double ulps(double x) {
    const auto steps = static_cast<int>(random_() % 9) - 4;
    const double towards = steps < 0 ? -INFINITY : INFINITY;
    for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, towards);
    return x;
  }
  Eigen::Vector3d vector(double length) { return length * Eigen::Vector3d(range(), range(), range()); }

 private:
  double range() { return random_() * 0x1p-31 - 1; }
  std::mt19937 random_;
};

Solid by_ulps(Solid solid, Nudge& nudge) {
  for (double& x : solid.translation) x = nudge.ulps(x);
  for (double& x : solid.rotation.reshaped()) x = nudge.ulps(x);
  return solid;
}

Solid by(double amount, Solid solid, Nudge& nudge) {
  solid.translation += nudge.vector(amount * radius(solid));
  const Eigen::Vector3d turn = nudge.vector(amount);
  solid.rotation = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * solid.rotation;
  return solid;
}

struct Neighbours : testing::TestWithParam<HardPose> {};

TEST_P(Neighbours, AreRightOrSaySo) {
  const HardPose& pose = GetParam();
  if (pose.a.kind == Kind::half_space) GTEST_SKIP() << "boxstream::ccd has no half-spaces";
  // Directions to try for the truth grow with the product of the edges; and boxstream::ccd goes to all its limits to be
  // unsure of two cones on one place.
  const bool is_unsure = pose.name == "cones_that_coincide";
  const bool is_slow = is_unsure || pose.a.points.size() * pose.b.points.size() > 1000;
  const int variants = is_slow ? most_variants / 5 : most_variants;
  int right = 0, all = 0;
  for (const double amount : {0.0, 1e-12, 1e-8}) {
    Nudge nudge(1);
    for (int i = 0; i < variants; ++i) {
      const Solid a = amount > 0 ? by(amount, pose.a, nudge) : by_ulps(pose.a, nudge);
      const Solid b = amount > 0 ? by(amount, pose.b, nudge) : by_ulps(pose.b, nudge);
      const Verdict verdict = ask_ccd(a, b);
      ASSERT_NE(verdict.kind, Verdict::Kind::wrong)
          << verdict.why << ": " << verdict.value << ", not " << verdict.truth << ", variant " << i << " by " << amount;
      EXPECT_NEAR(verdict.value, verdict.truth, 2e-6 * std::min(radius(a), radius(b)));
      right += verdict.kind == Verdict::Kind::right;
      ++all;
    }
  }
  if (!is_unsure) {
    EXPECT_GE(right, all * 9 / 10) << "of " << all << " the others say that they are not sure";
  }
}

BOXSTREAM_FOR_EVERY_POSE(Neighbours);

}  // namespace
}  // namespace boxstream::poses
