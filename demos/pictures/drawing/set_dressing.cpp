// SPDX-License-Identifier: MIT
#include <algorithm>
#include <limits>

#include "set_dressing.hpp"

namespace boxstream::picture {
namespace {

// Lines of sight that are tried; enough to tell a wall from a post.
constexpr std::size_t most_sights = 200;
// A box that covers less than this share of the subjects is part of the view.
constexpr double tolerated_share = 0.04;

std::vector<Vec3> subject_centres(const std::vector<Drawable>& drawables) {
  std::vector<Vec3> centres;
  for (const Drawable& d : drawables)
    if (d.subject)
      if (const auto ball = bounding_ball(d)) centres.push_back(ball->centre);
  const std::size_t stride = centres.size() / most_sights + 1;
  std::vector<Vec3> some;
  for (std::size_t i = 0; i < centres.size(); i += stride) some.push_back(centres[i]);
  return some;
}

/// Does the segment enter the box before its end, and end outside of it?
bool hides(const Box& box, const Transform& t, Vec3 eye, Vec3 end) {
  float enter = 0;
  float leave = 1;
  const float half[3] = {box.half_extents.x, box.half_extents.y, box.half_extents.z};
  for (int d = 0; d < 3; ++d) {
    const float from = dot(eye - t.origin, t.column[d]);
    const float step = dot(end - eye, t.column[d]);
    if (std::fabs(step) < 1e-12F) {
      if (std::fabs(from) > half[d]) return false;
      continue;
    }
    const float a = (-half[d] - from) / step;
    const float b = (half[d] - from) / step;
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave && leave < 1;
}

}  // namespace

void cut_away(std::vector<Drawable>& drawables, const Camera& camera) {
  const std::vector<Vec3> centres = subject_centres(drawables);
  std::erase_if(drawables, [&](const Drawable& d) {
    const Box* const box = std::get_if<Box>(&d.shape);
    if (d.subject || !box) return false;
    const auto hidden =
        std::count_if(centres.begin(), centres.end(), [&](Vec3 c) { return hides(*box, d.transform, camera.eye, c); });
    return static_cast<double>(hidden) > tolerated_share * static_cast<double>(centres.size());
  });
}

void add_floor(std::vector<Drawable>& drawables) {
  std::optional<float> lowest;
  for (const Drawable& d : drawables) {
    if (std::holds_alternative<Plane>(d.shape)) return;
    const auto y = lowest_point(d);
    if (y && (!lowest || *y < *lowest)) lowest = y;
  }
  if (!lowest) return;
  Drawable floor{Plane{}, {}, {0.78F, 0.79F, 0.80F}, false};
  floor.transform.origin.y = *lowest;
  drawables.push_back(floor);
}

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
