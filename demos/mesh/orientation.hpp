// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace boxstream::mesh {

using Vec2 = std::array<double, 2>;
using Vec3 = std::array<double, 3>;

/// The magnitudes for which the predicates are exact: 0, or between these. Beyond them products underflow or overflow.
inline constexpr double least_magnitude = 1e-70, largest_magnitude = 1e70;

/// The sign of (b - a) x (c - a): 1 if a, b, c turn to the left, 0 if they are on a line. Exact.
int orientation(const Vec2& a, const Vec2& b, const Vec2& c);

/// The sign of ((b - a) x (c - a)) . (d - a): 1 if d is where the normal of a, b, c points to, 0 if all four are in a
/// plane. Exact: a filter with a bound on its rounding error decides most cases, an Expansion the rest.
int orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

}  // namespace boxstream::mesh
