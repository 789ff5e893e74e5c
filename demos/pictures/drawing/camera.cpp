// SPDX-License-Identifier: MIT
#include "camera.hpp"

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include "set_dressing.hpp"

namespace boxstream::picture {
namespace {

// Share of the subjects on each side of the picture that may be cut off.
constexpr double outlier_share = 0.0008;
// Share of the half picture that stays free around the subjects.
constexpr float border = 0.05F;

// A body is astray if it is farther out of the middle nine tenths, on some axis, than this share of the crowd's width.
constexpr double middle_share = 0.05;
constexpr float stray_share = 0.5F;

/// Of one coordinate of all centres: what the middle nine tenths lie between.
std::pair<float, float> middle(const std::vector<Ball>& balls, float Vec3::*axis) {
  std::vector<float> values;
  for (const Ball& ball : balls) values.push_back(ball.centre.*axis);
  const auto skip = static_cast<std::ptrdiff_t>(static_cast<double>(values.size() - 1) * middle_share);
  std::nth_element(values.begin(), values.begin() + skip, values.end());
  const float low = values[static_cast<std::size_t>(skip)];
  std::nth_element(values.begin(), values.end() - 1 - skip, values.end());
  return {low, *(values.end() - 1 - skip)};
}

/// Takes out what flew away from the crowd. Of fewer than 21 nothing is astray.
void remove_strays(std::vector<Ball>& balls) {
  constexpr std::array<float Vec3::*, 3> axes{&Vec3::x, &Vec3::y, &Vec3::z};
  std::array<std::pair<float, float>, 3> crowd;
  std::transform(axes.begin(), axes.end(), crowd.begin(), [&](auto axis) { return middle(balls, axis); });
  float width = 0;
  for (const auto& [low, high] : crowd) width = std::max(width, high - low);
  std::erase_if(balls, [&](const Ball& ball) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
      const float place = ball.centre.*axes[i];
      if (place < crowd[i].first - stray_share * width || place > crowd[i].second + stray_share * width) return true;
    }
    return false;
  });
}

/// The value below which all but `outlier_share` of `values` lie. Reorders `values`.
float high_quantile(std::vector<float>& values) {
  const auto skip = static_cast<std::size_t>(static_cast<double>(values.size()) * outlier_share);
  const auto nth = values.end() - 1 - static_cast<std::ptrdiff_t>(skip);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

std::vector<Ball> balls_to_frame(std::span<const Drawable> drawables) {
  std::vector<Ball> balls;
  for (const bool subjects : {true, false}) {
    for (const Drawable& d : drawables) {
      if (d.subject != subjects) continue;
      if (const auto ball = bounding_ball(d)) balls.push_back(*ball);
    }
    if (subjects && !balls.empty()) remove_strays(balls);
    if (!balls.empty()) return balls;
  }
  return {{{0, 0, 0}, 1}};
}

}  // namespace

Camera frame(std::span<const Drawable> drawables, float aspect, ViewDirection from) {
  const std::vector<Ball> balls = balls_to_frame(drawables);
  const float degree = std::numbers::pi_v<float> / 180;
  Camera camera;
  const float azimuth = from.azimuth_degrees * degree;
  const float elevation = from.elevation_degrees * degree;
  const Vec3 back{std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
                  std::cos(elevation) * std::cos(azimuth)};
  const Vec3 right = normalized(cross(camera.up, back));
  const Vec3 up = cross(back, right);
  const float tan_up = std::tan(camera.field_of_view_degrees * degree / 2) * (1 - border);
  const float tan_right = tan_up * aspect;

  // Each side of the view pyramid touches the outermost ball on that side. The four sides fix where the eye is across
  // the view, and how far back: the wider of the two directions decides.
  std::vector<float> values(balls.size());
  const auto support = [&](Vec3 outward, float tangent) {
    const float slant = std::sqrt(1 + tangent * tangent);
    std::transform(balls.begin(), balls.end(), values.begin(), [&](const Ball& b) {
      return dot(b.centre, outward) + tangent * dot(b.centre, back) + slant * b.radius;
    });
    return high_quantile(values);
  };
  const float r = support(right, tan_right);
  const float l = support(right * -1, tan_right);
  const float t = support(up, tan_up);
  const float b = support(up * -1, tan_up);
  const float depth = std::max((r + l) / (2 * tan_right), (t + b) / (2 * tan_up));
  camera.eye = right * ((r - l) / 2) + up * ((t - b) / 2) + back * depth;

  std::transform(balls.begin(), balls.end(), values.begin(), [&](const Ball& ball) { return dot(ball.centre, back); });
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  const float distance = std::max(depth - *middle, 1e-3F);

  // The other direction has room to spare. Shared out evenly in space it looks uneven, because near things look larger:
  // move the eye until both sides have the same share of the picture.
  const auto reach = [&](Vec3 outward) {
    std::transform(balls.begin(), balls.end(), values.begin(), [&](const Ball& ball) {
      const Vec3 from_eye = ball.centre - camera.eye;
      return (dot(from_eye, outward) + ball.radius) / std::max(-dot(from_eye, back), 0.01F * distance);
    });
    return high_quantile(values);
  };
  for (int i = 0; i < 8; ++i)
    for (const Vec3 side : {right, up})
      camera.eye = camera.eye + side * ((reach(side) - reach(side * -1)) / 2 * distance);

  camera.target = camera.eye - back * distance;
  camera.scene_radius = distance * std::hypot(tan_up, tan_right);
  return camera;
}

}  // namespace boxstream::picture
