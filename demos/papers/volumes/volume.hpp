// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>
#include <concepts>
#include <limits>
#include <string>

namespace boxstream::papers::volumes {

/// Objects are given in float; all that is derived from them is double, which leaves room for cubes of any float.
using Point = Eigen::Vector3d;
using Points = Span<const Point>;

/// More than any sum of products of three terms here is off by rounding, as a part of the terms' magnitudes. Volumes
/// are made larger by it, and called disjoint only where they are so by more than it: rounding never loses a pair.
inline constexpr double slack = 16 * std::numeric_limits<double>::epsilon();

/// A bounding volume: convex, and not smaller than what it was made around, whatever the rounding.
/// - around(points), around(volumes): encloses all of them; at least one. The second is for hierarchies whose objects
///   moved, and may be looser than the first.
/// - merges_exactly: whether what encloses two volumes is as tight as what encloses all that they enclose.
/// - overlap(v, w): false only if they are disjoint.
/// - excess(p): at most 0 inside; outside, at most the distance from the volume, and more than 0.
/// - bounds(): an axis-aligned box around it.
/// - volume(), area(): of its surface. May be 0.
/// - name(): as tables show it.
template <class V>
concept Volume = requires(const V v, Points points, Span<const V> volumes, const Point p) {
  { V::around(points) } -> std::same_as<V>;
  { V::around(volumes) } -> std::same_as<V>;
  { overlap(v, v) } -> std::same_as<bool>;
  { v.excess(p) } -> std::same_as<double>;
  { v.bounds() } -> std::same_as<Aabb64>;
  { v.volume() } -> std::same_as<double>;
  { v.area() } -> std::same_as<double>;
  { V::merges_exactly } -> std::convertible_to<bool>;
  { V::name() } -> std::same_as<std::string>;
};

}  // namespace boxstream::papers::volumes
