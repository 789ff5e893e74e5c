// SPDX-License-Identifier: MIT
#include "revolution.hpp"

namespace boxstream::ccd {
namespace {

/// A core that is a solid of revolution: its axis (zero for a point), and the normal of its side.
struct Revolution {
  Vec axis;
  double outwards = 1;
  double along = 0;
};

std::optional<Revolution> revolution_of(const PlacedShape& placed) {
  const Shape& shape = placed.shape();
  if (std::holds_alternative<Sphere>(shape)) return Revolution{Vec::Zero()};
  const Vec axis = placed.rotation().col(2);
  if (std::holds_alternative<Capsule>(shape) || std::holds_alternative<Cylinder>(shape)) return Revolution{axis};
  if (const auto* const cone = std::get_if<Cone>(&shape)) {
    const double length = std::hypot(cone->height, cone->radius);
    if (length > 0) return Revolution{axis, cone->height / length, cone->radius / length};
    return Revolution{axis};
  }
  return std::nullopt;
}

/// How far the axes are from parallel and the matrices from rotations.
double deviation(const Revolution& a, const Revolution& b, const ShapePair& pair) {
  double most = a.axis.cross(b.axis).norm();
  for (const PlacedShape* const side : {&pair.a, &pair.b}) {
    const Eigen::Matrix3d& turn = side->rotation();
    most += (turn.transpose() * turn - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  }
  return most;
}

}  // namespace

std::optional<std::array<Vec, 2>> profile_normals(const ShapePair& pair) {
  const auto a = revolution_of(pair.a), b = revolution_of(pair.b);
  if (!a || !b || deviation(*a, *b, pair) * pair.extent > pair.tolerance / 8) return std::nullopt;
  const Vec axis = a->axis.squaredNorm() > 0 ? a->axis : b->axis;
  if (!(axis.squaredNorm() > 0)) return std::array<Vec, 2>{Vec::UnitX(), Vec::UnitX()};
  const Vec between = pair.b.centre() - pair.a.centre();
  Vec across = between - between.dot(axis) * axis;
  // A second time, for short vectors: the first result carries the rounding error of the long one.
  across -= across.dot(axis) * axis;
  const double length = across.norm();
  // For coaxial solids any half-plane will do.
  const Vec outwards = length > pair.noise ? Vec(across / length) : Vec(axis.unitOrthogonal());
  return std::array<Vec, 2>{outwards * a->outwards + a->axis * a->along, outwards * b->outwards - b->axis * b->along};
}

}  // namespace boxstream::ccd
