// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/ccd.hpp>
#include <optional>

namespace boxstream::ccd {

using Vec = Eigen::Vector3d;

/// A shape where the solvers see it: turned, then scaled about the origin of the pair, then shifted.
class Posed {
 public:
  Posed(const Shape& shape, const Pose& pose, const Vec& origin, double scale)
      : shape_(&shape), rotation_(&pose.rotation), shift_((pose.translation - origin) * scale), scale_(scale) {}

  /// A point of the core that is farthest along `direction` (not zero, any length).
  Vec core_support(const Vec& direction) const;
  /// The same for the whole shape.
  Vec support(const Vec& direction) const;
  /// What is added to the core on all sides.
  double rounding() const;
  /// A point inside.
  Vec centre() const;
  void move(const Vec& by) { shift_ += by; }
  const Eigen::Matrix3d& rotation() const { return *rotation_; }
  bool is_box() const { return std::holds_alternative<Box>(*shape_); }

 private:
  const Shape* shape_;
  const Eigen::Matrix3d* rotation_;
  Vec shift_;
  double scale_;
};

/// Radius of a sphere around the local origin that contains the shape; empty if the shape is not valid.
std::optional<double> radius_of(const Shape& shape);

/// Finite, and a rotation up to what single precision leaves of one.
bool is_valid(const Pose& pose);

/// A point of the core in the shape's own frame.
Vec local_core_support(const Shape& shape, const Vec& direction);
double rounding_of(const Shape& shape);

}  // namespace boxstream::ccd
