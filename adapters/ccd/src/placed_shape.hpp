// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/ccd.hpp>
#include <optional>

namespace boxstream::ccd {

using Vec = Eigen::Vector3d;

/// A shape in the frame of the solvers: moved to its own centre, rotated, scaled, then shifted.
class PlacedShape {
 public:
  PlacedShape(const Shape& shape, const Pose& pose, const Vec& local_centre, const Vec& shift, double scale)
      : shape_(&shape), rotation_(&pose.rotation), local_centre_(local_centre), shift_(shift), scale_(scale) {}

  /// A point of the core that is farthest along `direction` (not zero, any length).
  Vec core_support(const Vec& direction) const;
  /// The same for the whole shape.
  Vec support(const Vec& direction) const;
  /// What is added to the core on all sides.
  double rounding() const;
  /// Of the sphere that `ball_of` gives: inside the shape or, for a hull, its box.
  const Vec& centre() const { return shift_; }
  /// A point inside.
  Vec inside() const;
  void move(const Vec& by) { shift_ += by; }
  const Eigen::Matrix3d& rotation() const { return *rotation_; }
  const Shape& shape() const { return *shape_; }
  /// The core is a point, a segment or a box.
  bool is_boxy() const { return is<Sphere>() || is<Capsule>() || is<Box>(); }
  /// The core is curved somewhere.
  bool is_curved() const { return is<Cylinder>() || is<Cone>(); }

 private:
  template <class Kind>
  bool is() const {
    return std::holds_alternative<Kind>(*shape_);
  }
  Vec place(const Vec& local) const { return *rotation_ * (local - local_centre_) * scale_ + shift_; }

  const Shape* shape_;
  const Eigen::Matrix3d* rotation_;
  Vec local_centre_;
  Vec shift_;
  double scale_;
};

/// A sphere in the shape's own frame that contains it, around its middle: a hull's may be far from the local origin.
struct Ball {
  Vec centre;
  double radius;
};

/// Empty if the shape is not valid.
std::optional<Ball> ball_of(const Shape& shape);

/// Finite, and a rotation up to what single precision leaves of one.
bool is_valid(const Pose& pose);

/// A point of the core in the shape's own frame.
Vec local_core_support(const Shape& shape, const Vec& direction);
double rounding_of(const Shape& shape);

}  // namespace boxstream::ccd
