// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>

#include <random>
#include <string>
#include <vector>

#include "references/closed_forms.hpp"

/// Pairs of shapes in poses of which the truth is known.
namespace boxstream::report::narrow {

/// The same numbers for the same seed, with every standard library.
class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : engine_(seed) {}

  double range(double low, double high) { return low + (high - low) * (engine_() * 0x1p-32); }
  /// A unit vector.
  Eigen::Vector3d direction() {
    for (;;)
      if (const Eigen::Vector3d v(range(-1, 1), range(-1, 1), range(-1, 1)); v.norm() > 0.1 && v.norm() < 1)
        return v.normalized();
  }
  Eigen::Matrix3d rotation() { return Eigen::AngleAxisd(range(0, 3), direction()).toRotationMatrix(); }

 private:
  std::mt19937 engine_;
};

struct Pose {
  RoundedBox a, b;
  double truth = 0;  ///< signed distance of the numbers as they are
  double size = 0;   ///< radius of the smaller shape, of which errors and gaps are fractions
};

struct PoseRequest {
  /// Two of "sphere", "capsule", "box", "ball", "pill", "slab" with a dash between. All balls are alike, and so are all
  /// pills, which are capsules. A slab is a box beside which another one lies flush: both are turned alike, and two
  /// faces are parallel.
  std::string pair;
  /// Signed gap as a fraction of the size: spread evenly in its logarithm from the first to the second.
  double first_gap = 0, last_gap = 0;
  bool both_signs = false;  ///< every other gap has the other sign
  double scale = 1;         ///< radii and half sides are 0.3 to 1 of it, those of balls and pills 0.5
  int count = 0;
};

/// The same for the same request. Throws std::invalid_argument for a pair that is not one, and for a count below one.
std::vector<Pose> make_poses(const PoseRequest& request);

}  // namespace boxstream::report::narrow
