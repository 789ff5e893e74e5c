// SPDX-License-Identifier: MIT
#include "oracle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxstream::ccd_test {
namespace {

Vec local(const Vec& point, const ccd::Pose& pose) {
  return pose.rotation.transpose() * (point - pose.translation);
}

double point_to_segment(const Vec& p, const Vec& a, const Vec& b) {
  const Vec edge = b - a;
  const double length2 = edge.squaredNorm();
  const double t = length2 > 0 ? std::clamp((p - a).dot(edge) / length2, 0.0, 1.0) : 0;
  return (p - a - t * edge).norm();
}

/// Signed distance in the plane to a convex polygon whose edges run counter-clockwise; it is unbounded where it is cut
/// off at r = 0, the axis of a body of revolution.
double point_to_polygon(double r, double z, const std::vector<std::array<double, 4>>& edges) {
  double outside = std::numeric_limits<double>::infinity(), inside = -std::numeric_limits<double>::infinity();
  bool in = true;
  for (const auto& [r0, z0, r1, z1] : edges) {
    const double length = std::hypot(r1 - r0, z1 - z0);
    const double side = ((r - r0) * (z1 - z0) - (z - z0) * (r1 - r0)) / length;
    in &= side <= 0;
    inside = std::max(inside, side);
    outside = std::min(outside, point_to_segment({r, z, 0}, {r0, z0, 0}, {r1, z1, 0}));
  }
  return in ? inside : outside;
}

/// The corners, turned as in the world, around the shape's own origin.
std::vector<Vec> corners(const ccd::Shape& shape, const ccd::Pose& pose) {
  std::vector<Vec> points;
  if (const auto* const box = std::get_if<ccd::Box>(&shape)) {
    for (int i = 0; i < 8; ++i)
      points.push_back(box->half_extents.cwiseProduct(Vec(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  } else {
    points = std::get<ccd::ConvexHull>(shape).points;
  }
  for (Vec& p : points) p = pose.rotation * p;
  return points;
}

std::vector<Vec> edge_directions(const ccd::Shape& shape, const ccd::Pose& pose) {
  if (std::holds_alternative<ccd::Box>(shape))
    return {pose.rotation.col(0), pose.rotation.col(1), pose.rotation.col(2)};
  const std::vector<Vec> points = corners(shape, pose);
  std::vector<Vec> edges;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) edges.push_back((points[j] - points[i]).normalized());
  return edges;
}

}  // namespace

double segment_distance(const Vec& a0, const Vec& a1, const Vec& b0, const Vec& b1) {
  double best = std::min(std::min(point_to_segment(a0, b0, b1), point_to_segment(a1, b0, b1)),
                         std::min(point_to_segment(b0, a0, a1), point_to_segment(b1, a0, a1)));
  const Vec u = a1 - a0, v = b1 - b0, w = a0 - b0;
  const double uu = u.dot(u), uv = u.dot(v), vv = v.dot(v), det = uu * vv - uv * uv;
  if (det > 1e-12 * uu * vv) {
    const double s = (uv * v.dot(w) - vv * u.dot(w)) / det, t = (uu * v.dot(w) - uv * u.dot(w)) / det;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, std::abs(u.cross(v).normalized().dot(w)));
  }
  return best;
}

double point_to_box(const Vec& point, const ccd::Box& box, const ccd::Pose& pose) {
  const Vec beyond = local(point, pose).cwiseAbs() - box.half_extents;
  return beyond.maxCoeff() <= 0 ? beyond.maxCoeff() : beyond.cwiseMax(0).norm();
}

double point_to_cylinder(const Vec& point, const ccd::Cylinder& cylinder, const ccd::Pose& pose) {
  const Vec p = local(point, pose);
  const double across = std::hypot(p.x(), p.y()) - cylinder.radius, along = std::abs(p.z()) - cylinder.height / 2;
  if (across <= 0 && along <= 0) return std::max(across, along);
  return std::hypot(std::max(across, 0.0), std::max(along, 0.0));
}

double point_to_cone(const Vec& point, const ccd::Cone& cone, const ccd::Pose& pose) {
  const Vec p = local(point, pose);
  const double h = cone.height / 2;
  return point_to_polygon(std::hypot(p.x(), p.y()), p.z(), {{0, -h, cone.radius, -h}, {cone.radius, -h, 0, h}});
}

double reach(const ccd::Shape& shape, const ccd::Pose& pose, const Vec& unit) {
  const Vec d = pose.rotation.transpose() * unit;
  const double across = std::hypot(d.x(), d.y());
  struct {
    const Vec& d;
    double across;
    double operator()(const ccd::Box& b) const { return d.cwiseAbs().dot(b.half_extents); }
    double operator()(const ccd::Sphere& s) const { return s.radius; }
    double operator()(const ccd::Capsule& c) const { return c.radius + std::abs(d.z()) * c.height / 2; }
    double operator()(const ccd::Cylinder& c) const { return c.radius * across + std::abs(d.z()) * c.height / 2; }
    double operator()(const ccd::Cone& c) const {
      return std::max(d.z() * c.height / 2, c.radius * across - d.z() * c.height / 2);
    }
    double operator()(const ccd::ConvexHull& h) const {
      double most = -std::numeric_limits<double>::infinity();
      for (const Vec& p : h.points) most = std::max(most, d.dot(p));
      return most;
    }
  } const local_reach{d, across};
  return std::visit(local_reach, shape) + unit.dot(pose.translation);
}

double way_out(const ccd::Shape& a, const ccd::Pose& pose_a, const ccd::Shape& b, const ccd::Pose& pose_b,
               const Vec& unit) {
  // Relative to A, so that pairs far out keep their digits.
  ccd::Pose at_origin(pose_a.rotation, Vec::Zero()), relative(pose_b.rotation, pose_b.translation - pose_a.translation);
  return reach(a, at_origin, unit) + reach(b, relative, -unit);
}

double least_way_out(const ccd::Shape& a, const ccd::Pose& pose_a, const ccd::Shape& b, const ccd::Pose& pose_b) {
  double best = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec& direction) {
    const double length = direction.norm();
    if (!(length > 1e-9)) return;
    best = std::min(best, way_out(a, pose_a, b, pose_b, direction / length));
    best = std::min(best, way_out(a, pose_a, b, pose_b, direction / -length));
  };
  const std::vector<Vec> edges_a = edge_directions(a, pose_a), edges_b = edge_directions(b, pose_b);
  for (const std::vector<Vec>* const edges : {&edges_a, &edges_b})
    for (std::size_t i = 0; i < edges->size(); ++i)
      for (std::size_t j = i + 1; j < edges->size(); ++j) offer((*edges)[i].cross((*edges)[j]));
  for (const Vec& u : edges_a)
    for (const Vec& v : edges_b) offer(u.cross(v));
  return best;
}

double searched_way_out(const ccd::Shape& a, const ccd::Pose& pose_a, const ccd::Shape& b, const ccd::Pose& pose_b,
                        RandomShapes& random) {
  double best = std::numeric_limits<double>::infinity();
  for (int start = 0; start < 16; ++start) {
    Vec at = random.direction();
    double width = way_out(a, pose_a, b, pose_b, at);
    for (double step = 0.5; step > 1e-7;) {
      bool better = false;
      for (int i = 0; i < 6 && !better; ++i) {
        const Vec tried = (at + step * random.direction()).normalized();
        const double w = way_out(a, pose_a, b, pose_b, tried);
        if (w < width) width = w, at = tried, better = true;
      }
      if (!better) step *= 0.6;
    }
    best = std::min(best, width);
  }
  return best;
}

}  // namespace boxstream::ccd_test
