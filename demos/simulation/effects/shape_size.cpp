// SPDX-License-Identifier: MIT
#include "simulation/effects/shape_size.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace boxstream::effects {

using namespace scenes;

namespace {

/// Whole extents in metres from which on Bullet's own contacts hold bodies at their heights to a thousandth of their
/// size: measured at rest on planes and boxes, at 60 steps a second.
constexpr double enough_for_balls = 0.02, enough_for_boxes = 0.12, enough_for_hulls = 0.35;
/// Discs on boxes and, in double precision, cones rock by a millimetre.
constexpr double enough_for_round = 2;
/// Of several parts. Bullet drops the contacts of a part that lifts off by less than it falls in a step, so that what
/// stands on feet rocks by up to 2.7 mm.
constexpr double enough_for_compounds = 2.5;

double largest(const std::vector<Vec3>& points) {
  double most = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto [low, high] =
        std::minmax_element(points.begin(), points.end(), [&](const Vec3& a, const Vec3& b) { return a[d] < b[d]; });
    most = std::max(most, (*high)[d] - (*low)[d]);
  }
  return most;
}

}  // namespace

ShapeSize size_of(const std::vector<Shape>& shapes, std::size_t index) {
  const auto of = [&]<class S>(const S& s) -> ShapeSize {
    if constexpr (std::is_same_v<S, BoxShape>) {
      return {2 * std::max({s.half_extents[0], s.half_extents[1], s.half_extents[2]}), enough_for_boxes};
    } else if constexpr (std::is_same_v<S, SphereShape>) {
      return {2 * s.radius, enough_for_balls};
    } else if constexpr (std::is_same_v<S, CapsuleShape>) {
      return {s.height + 2 * s.radius, enough_for_boxes};
    } else if constexpr (std::is_same_v<S, CylinderShape> || std::is_same_v<S, ConeShape>) {
      return {std::max(s.height, 2 * s.radius), enough_for_round};
    } else if constexpr (std::is_same_v<S, HullShape>) {
      return {largest(s.points), enough_for_hulls};
    } else if constexpr (std::is_same_v<S, CompoundShape>) {
      // Parts lie apart: a compound is as large as they reach.
      const bool has_parts = s.children.size() > 1;
      ShapeSize all{0, has_parts ? enough_for_compounds : 0};
      for (const CompoundChild& child : s.children) {
        const ShapeSize part = size_of(shapes, child.shape);
        double away = 0;
        for (const double x : child.position) away = std::max(away, std::abs(x));
        all.largest = std::max(all.largest, part.largest + (has_parts ? away : 0));
        all.enough = std::max(all.enough, part.enough);
      }
      return all;
    } else {
      return {};
    }
  };
  return std::visit(of, shapes[index].value);
}

}  // namespace boxstream::effects
