// SPDX-License-Identifier: MIT
#include "shape_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxstream::ccd {
namespace {

/// libccd treats squared lengths below 2e-16 as zero, so smaller scaled tolerances would make no difference.
constexpr double least_scaled_tolerance = 1e-7;
/// Keeps products of four lengths finite.
constexpr double largest_scaled_extent = 1e70;
constexpr double smallest_extent = 1e-150;

}  // namespace

std::optional<ShapePair> make_shape_pair(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                         const Options& options) {
  const std::optional<Ball> ball_a = ball_of(a), ball_b = ball_of(b);
  if (!ball_a || !ball_b || !is_valid(pose_a) || !is_valid(pose_b)) return std::nullopt;
  if (!(options.tolerance > 0) || !(options.tolerance < 1) || options.max_iterations < 1) return std::nullopt;
  // Differences first: common offsets of poses and of hulls then cost no precision.
  const Vec apart = pose_b.translation - pose_a.translation;
  const Vec turned_a = pose_a.rotation * ball_a->centre, turned_b = pose_b.rotation * ball_b->centre;
  const Vec between = apart + (turned_b - turned_a);
  const double extent = ball_a->radius + ball_b->radius + between.stableNorm();
  const double largest = extent + apart.stableNorm() + ball_a->centre.stableNorm() + ball_b->centre.stableNorm();
  if (!std::isfinite(largest)) return std::nullopt;

  double size = std::min(ball_a->radius, ball_b->radius);
  if (!(size > smallest_extent)) size = std::max(ball_a->radius, ball_b->radius);
  if (!(size > smallest_extent)) size = extent > smallest_extent ? extent : 1;
  const double stretch = std::max(1.0, least_scaled_tolerance / options.tolerance);
  const double scale = std::min(stretch / size, largest_scaled_extent / std::max(extent, size));
  const double noise = 16 * std::numeric_limits<double>::epsilon() * largest * scale;
  const double tolerance = std::max(options.tolerance * size * scale, 8 * noise);

  const PlacedShape posed_a(a, pose_a, ball_a->centre, Vec::Zero(), scale);
  const PlacedShape posed_b(b, pose_b, ball_b->centre, between * scale, scale);
  const double rounding = posed_a.rounding() + posed_b.rounding();
  return ShapePair{posed_a,        posed_b, pose_a.translation + turned_a, scale, size * scale, tolerance, noise,
                   extent * scale, rounding};
}

}  // namespace boxstream::ccd
