// SPDX-License-Identifier: MIT
// Formulas: point and box, segment and segment: Ericson, Real-Time Collision Detection (2005), 5.1.3 and 5.1.9.
// Overlapping boxes: separating axes, Gottschalk, Lin, Manocha, OBBTree (1996), 5. The depth of a sum of convex sets is
// that of the set without its ball, and the ball's radius, since support functions add.
#include "references/closed_forms.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace boxstream::report {
namespace {

using Vec = Eigen::Matrix<Real, 3, 1>;
using Mat = Eigen::Matrix<Real, 3, 3>;

struct Segment {
  Vec start, end;
};

/// The box without its margin.
struct Core {
  Vec centre, half;
  Mat axes;

  Real reach(const Vec& unit) const { return half.dot((axes.transpose() * unit).cwiseAbs()); }
};

Core core_of(const RoundedBox& solid, const Eigen::Vector3d& origin) {
  return {solid.centre.cast<Real>() - origin.cast<Real>(), solid.half.cast<Real>(), solid.rotation.cast<Real>()};
}

std::vector<Vec> corners(const Core& core) {
  std::vector<Vec> all{core.centre};
  for (int axis = 0; axis < 3; ++axis) {
    if (core.half[axis] == 0) continue;
    std::vector<Vec> both;
    for (const Vec& at : all)
      for (const Real side : {-core.half[axis], core.half[axis]}) both.push_back(at + side * core.axes.col(axis));
    all = std::move(both);
  }
  return all;
}

std::vector<Segment> edges(const Core& core) {
  std::vector<Segment> all;
  for (int axis = 0; axis < 3; ++axis) {
    if (core.half[axis] == 0) continue;
    Core across = core;
    across.half[axis] = 0;
    const Vec along = core.half[axis] * core.axes.col(axis);
    for (const Vec& middle : corners(across)) all.push_back({middle - along, middle + along});
  }
  return all;
}

Real to_box(const Vec& point, const Core& box) {
  const Vec local = box.axes.transpose() * (point - box.centre);
  return (local.cwiseAbs() - box.half).cwiseMax(Vec::Zero()).norm();
}

/// The lines' closest points if they are in the segments, else the closest of what a clamped end leaves.
Real between(const Segment& p, const Segment& q) {
  const Vec u = p.end - p.start, v = q.end - q.start, w = p.start - q.start;
  const Real uu = u.squaredNorm(), vv = v.squaredNorm(), uv = u.dot(v), uw = u.dot(w), vw = v.dot(w);
  const Real determinant = uu * vv - uv * uv;
  const auto clamp = [](Real t) { return std::clamp<Real>(t, 0, 1); };
  Real s = determinant > 0 ? clamp((uv * vw - vv * uw) / determinant) : 0;
  const Real t = clamp((uv * s + vw) / vv);
  s = clamp((uv * t - uw) / uu);
  return (w + s * u - t * v).norm();
}

/// Of cores that are apart, or flat and crossing: two of their corners, edges and faces are closest.
Real apart(const Core& a, const Core& b) {
  Real least = std::numeric_limits<Real>::infinity();
  for (const Vec& corner : corners(a)) least = std::min(least, to_box(corner, b));
  for (const Vec& corner : corners(b)) least = std::min(least, to_box(corner, a));
  const std::vector<Segment> of_b = edges(b);
  for (const Segment& p : edges(a))
    for (const Segment& q : of_b) least = std::min(least, between(p, q));
  return least;
}

/// The largest gap along the normals of faces of their difference: negative if, and only if, their insides overlap.
Real gap_along_axes(const Core& a, const Core& b) {
  Real most = -std::numeric_limits<Real>::infinity();
  const Vec between_centres = b.centre - a.centre;
  const auto try_axis = [&](const Vec& axis) {
    // Of parallel edges rounding alone is left; the faces beside them are better.
    const Real length = axis.norm();
    if (!(length > 1e-12L)) return;
    const Vec unit = axis / length;
    most = std::max(most, std::abs(unit.dot(between_centres)) - a.reach(unit) - b.reach(unit));
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(a.axes.col(i));
    try_axis(b.axes.col(i));
    for (int j = 0; j < 3; ++j) try_axis(a.axes.col(i).cross(b.axes.col(j)));
  }
  return most;
}

}  // namespace

double radius(const RoundedBox& solid) {
  return solid.half.norm() + solid.margin;
}

Real signed_distance(const RoundedBox& a, const RoundedBox& b) {
  const Core core_a = core_of(a, a.centre), core_b = core_of(b, a.centre);
  const Real gap = gap_along_axes(core_a, core_b);
  const Real of_cores = gap < 0 ? gap : apart(core_a, core_b);
  return of_cores - static_cast<Real>(a.margin) - static_cast<Real>(b.margin);
}

}  // namespace boxstream::report
