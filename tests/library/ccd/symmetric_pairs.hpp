// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "random_shapes.hpp"

/// Pairs that lie deep in one another and that many directions part equally well, or nearly: on one centre, on one
/// axis, turned by right angles, by next to nothing, at random.
namespace boxstream::ccd_test {

constexpr const char* kind_names[] = {"box", "sphere", "capsule", "cylinder", "cone", "hull of 8", "hull of 400"};
constexpr int kinds_and_big_hulls = 7;

struct PosedPair {
  std::string what;
  ccd::Shape a, b;
  ccd::Pose pose_a, pose_b;
};

/// Points of a ball's surface.
inline ccd::ConvexHull ball_of_points(RandomShapes& random, int points, double radius) {
  ccd::ConvexHull hull;
  for (int i = 0; i < points; ++i) hull.points.push_back(random.direction() * radius);
  return hull;
}

/// Sizes of one, two or a half now and then, so that faces coincide.
inline ccd::Shape deep_shape(int kind, RandomShapes& random, double scale, bool plain) {
  const auto length = [&] {
    return scale * (plain ? std::exp2(std::floor(random.range(-1, 2))) : random.size(0.3, 3));
  };
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
    case 5:
      return ball_of_points(random, 8, length());
    default:
      return ball_of_points(random, 400, length());
  }
}

/// A turn that takes axes to axes.
inline Eigen::Matrix3d quarter_turns(RandomShapes& random) {
  const auto turn = [&](int axis) -> Eigen::Matrix3d {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    Eigen::Matrix3d m = unit * unit.transpose();
    m((axis + 1) % 3, (axis + 2) % 3) = -1;
    m((axis + 2) % 3, (axis + 1) % 3) = 1;
    return m;
  };
  Eigen::Matrix3d m = Eigen::Matrix3d::Identity();
  for (int i = 0; i < 3; ++i)
    if (random.range(0, 1) < 0.5) m = turn(i) * m;
  return m;
}

/// One pair of two kinds for each seed; the second may be larger.
inline PosedPair symmetric_pair(int kind_a, int kind_b, std::uint64_t seed, double scale = 1, double most_ratio = 1) {
  RandomShapes random(seed * 100 + static_cast<std::uint64_t>(kind_a * 10 + kind_b));
  const bool plain = seed % 2 == 0;
  PosedPair pair{"",
                 deep_shape(kind_a, random, scale, plain),
                 deep_shape(kind_b, random, scale * random.size(1, most_ratio), plain),
                 {},
                 {}};
  if (kind_a == kind_b && seed % 5 == 0) pair.b = pair.a;
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec place = Vec::Zero();
  switch (seed % 7) {
    case 0:
      pair.what = "on one centre";
      break;
    case 1:
      pair.what = "on one centre, quarter turns";
      turn = quarter_turns(random);
      break;
    case 2:
      pair.what = "on one centre, turned";
      turn = random.rotation();
      break;
    case 3:
      pair.what = "on one axis";
      place.z() = scale * random.range(-0.5, 0.5);
      break;
    case 4:
      pair.what = "nearly on one axis";
      turn = Eigen::AngleAxisd(random.size(1e-10, 1e-1), random.direction()).toRotationMatrix();
      place = scale * random.size(1e-10, 1e-1) * random.direction();
      break;
    case 5:
      pair.what = "beside, quarter turns";
      turn = quarter_turns(random);
      place = 0.25 * scale * std::floor(random.range(-2, 3)) * Vec::UnitX();
      break;
    default:
      pair.what = "nearly on one centre, nearly quarter turns";
      turn = quarter_turns(random) * Eigen::AngleAxisd(random.size(1e-10, 1e-1), random.direction()).toRotationMatrix();
      place = scale * random.size(1e-10, 1e-1) * random.direction();
  }
  // The world is turned, too, half of the time.
  const Eigen::Matrix3d world = seed % 3 == 0 ? random.rotation() : Eigen::Matrix3d::Identity();
  pair.pose_a = {world, Vec::Zero()};
  pair.pose_b = {world * turn, world * place};
  pair.what += ": " + std::string(kind_names[kind_a]) + ", " + kind_names[kind_b] + ", seed " + std::to_string(seed);
  return pair;
}

}  // namespace boxstream::ccd_test
