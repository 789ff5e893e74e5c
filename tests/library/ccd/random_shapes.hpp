// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/ccd.hpp>
#include <cstdint>
#include <random>

namespace boxstream::ccd_test {

using Vec = Eigen::Vector3d;

/// Shapes and poses of all kinds and sizes, the same for the same seed.
class RandomShapes {
 public:
  explicit RandomShapes(std::uint64_t seed) : engine_(seed) {}

  double range(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  /// Every octave between the two is equally likely.
  double size(double low, double high) { return low * std::exp(range(0, std::log(high / low))); }
  Vec direction() {
    for (;;)
      if (const Vec v(range(-1, 1), range(-1, 1), range(-1, 1)); v.squaredNorm() > 0.01 && v.squaredNorm() < 1)
        return v.normalized();
  }
  Eigen::Matrix3d rotation() {
    for (;;) {
      Eigen::Quaterniond q(range(-1, 1), range(-1, 1), range(-1, 1), range(-1, 1));
      if (q.norm() > 0.1) return q.normalized().toRotationMatrix();
    }
  }
  ccd::Pose pose(const Vec& centre, double spread) { return {rotation(), centre + spread * range(0, 1) * direction()}; }

  static constexpr int kinds = 6;
  /// Box, sphere, capsule, cylinder, cone, hull of eight points; about as large as `scale`.
  ccd::Shape shape(int kind, double scale) {
    const auto length = [&] { return size(0.3, 2) * scale; };
    switch (kind) {
      case 0:
        return ccd::Box{{length(), length(), length()}};
      case 1:
        return ccd::Sphere{length()};
      case 2:
        return ccd::Capsule{length(), length()};
      case 3:
        return ccd::Cylinder{length(), length()};
      case 4:
        return ccd::Cone{length(), length()};
      default: {
        ccd::ConvexHull hull;
        for (int i = 0; i < 8; ++i) hull.points.push_back(direction() * length());
        return hull;
      }
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace boxstream::ccd_test
