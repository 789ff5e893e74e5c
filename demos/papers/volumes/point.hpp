// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <limits>

#include <boxstream/span.hpp>

namespace boxstream::papers::volumes {

/// Objects are given in float; all that is derived from them is double, which leaves room for cubes of any float.
using Point = Eigen::Vector3d;
using Points = Span<const Point>;

/// More than any sum of products of three terms here is off by rounding, as a part of the terms' magnitudes. Volumes
/// are made larger by it, and called disjoint only where they are so by more than it: rounding never loses a pair.
inline constexpr double slack = 16 * std::numeric_limits<double>::epsilon();

}  // namespace boxstream::papers::volumes
