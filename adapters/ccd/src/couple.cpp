// SPDX-License-Identifier: MIT
#include "couple.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxstream::ccd {
namespace {

/// libccd takes squared lengths below 2e-16 for zero, in either sense of touching: smaller tolerances than this, once
/// scaled, would be below what it distinguishes.
constexpr double least_scaled_tolerance = 1e-7;
/// Keeps products of four lengths finite.
constexpr double largest_scaled_extent = 1e70;
constexpr double smallest_extent = 1e-150;

}  // namespace

std::optional<Couple> make_couple(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                  const Options& options) {
  const std::optional<double> radius_a = radius_of(a), radius_b = radius_of(b);
  if (!radius_a || !radius_b || !is_valid(pose_a) || !is_valid(pose_b)) return std::nullopt;
  if (!(options.tolerance > 0) || !(options.tolerance < 1) || options.max_iterations < 1) return std::nullopt;
  const Vec between = pose_b.translation - pose_a.translation;
  const double extent = *radius_a + *radius_b + between.stableNorm();
  if (!std::isfinite(extent)) return std::nullopt;

  double size = std::min(*radius_a, *radius_b);
  if (!(size > smallest_extent)) size = std::max(*radius_a, *radius_b);
  if (!(size > smallest_extent)) size = extent > smallest_extent ? extent : 1;
  const double stretch = std::max(1.0, least_scaled_tolerance / options.tolerance);
  const double scale = std::min(stretch / size, largest_scaled_extent / std::max(extent, size));
  const double noise = 16 * std::numeric_limits<double>::epsilon() * extent * scale;
  const double tolerance = std::max(options.tolerance * size * scale, 8 * noise);

  const Vec origin = pose_a.translation;
  const Posed posed_a(a, pose_a, origin, scale), posed_b(b, pose_b, origin, scale);
  return Couple{posed_a, posed_b, origin, scale, tolerance, noise, posed_a.rounding() + posed_b.rounding()};
}

}  // namespace boxstream::ccd
