// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <random>

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

}  // namespace boxstream::report::narrow
