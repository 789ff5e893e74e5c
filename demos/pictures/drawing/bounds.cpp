// SPDX-License-Identifier: MIT
#include "bounds.hpp"

#include <algorithm>
#include <limits>

namespace boxstream::picture {
namespace {

struct LocalBall {
  Ball operator()(const Box& s) const { return {{}, length(s.half_extents)}; }
  Ball operator()(const Sphere& s) const { return {{}, s.radius}; }
  Ball operator()(const Capsule& s) const { return {{}, s.radius + s.half_length}; }
  Ball operator()(const Cylinder& s) const { return {{}, std::hypot(s.radius, s.half_length)}; }
  Ball operator()(const Cone& s) const { return {{}, std::hypot(s.radius, s.half_length)}; }
  Ball operator()(const Plane&) const { return {{}, -1}; }
  Ball operator()(const std::shared_ptr<const Mesh>& mesh) const {
    if (!mesh || mesh->vertices.empty()) return {{}, -1};
    Vec3 lo = mesh->vertices[0];
    Vec3 hi = lo;
    for (const Vec3 v : mesh->vertices) {
      lo = {std::min(lo.x, v.x), std::min(lo.y, v.y), std::min(lo.z, v.z)};
      hi = {std::max(hi.x, v.x), std::max(hi.y, v.y), std::max(hi.z, v.z)};
    }
    return {(lo + hi) * 0.5F, length(hi - lo) * 0.5F};
  }
};

}  // namespace

std::optional<Ball> bounding_ball(const Drawable& drawable) {
  Ball ball = std::visit(LocalBall{}, drawable.shape);
  if (!(ball.radius >= 0)) return std::nullopt;
  ball.centre = drawable.transform.point(ball.centre);
  if (!is_finite(ball.centre) || !std::isfinite(ball.radius)) return std::nullopt;
  return ball;
}

std::optional<float> lowest_point(const Drawable& drawable) {
  const auto ball = bounding_ball(drawable);
  if (!ball) return std::nullopt;
  const Transform& t = drawable.transform;
  if (const Box* const box = std::get_if<Box>(&drawable.shape)) {
    const Vec3 half = box->half_extents;
    return t.origin.y - std::fabs(t.column[0].y) * half.x - std::fabs(t.column[1].y) * half.y -
           std::fabs(t.column[2].y) * half.z;
  }
  float lowest = ball->centre.y - ball->radius;
  if (const auto* const mesh = std::get_if<std::shared_ptr<const Mesh>>(&drawable.shape)) {
    lowest = std::numeric_limits<float>::max();
    for (const Vec3 v : (*mesh)->vertices) lowest = std::min(lowest, t.point(v).y);
  }
  return lowest;
}

}  // namespace boxstream::picture
