// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "papers/volumes/builders.hpp"
#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

struct PrincipalAxes {
  Point barycentre;
  Eigen::Matrix3d axes;  ///< columns, orthonormal within rounding, by rising variance of the points along them
};

/// Of the covariance matrix of at least one point. Points that are all the same get some axes.
PrincipalAxes principal_axes(Points points);

/// Two halves, along the longest side of the box of all centres.
std::size_t split_at_median(const Atoms& atoms, Span<std::uint32_t> objects);

/// Section 5.1.4: for each axis, sort by centres and find the j that makes Area(b1, .., bj) j + Area(bj+1, .., bn) (n -
/// j) least; the best of the three. The printed division by Area(B) is the same for all and so left out. Of equals, the
/// j nearest to the middle: without that, objects in one plane, whose volumes are all 0, would become a list. O(n log
/// n) a level.
std::size_t split_by_surface_area(const Atoms& atoms, Span<std::uint32_t> objects);
/// The same with volumes instead of areas: for point queries, range queries and collision detection.
std::size_t split_by_volume(const Atoms& atoms, Span<std::uint32_t> objects);

/// Section 5.1.4: at the plane through the barycentre of all centres, across the axis along which they vary most.
/// Where all are on one side of it by rounding: two halves along that axis.
std::size_t split_across_principal_axis(const Atoms& atoms, Span<std::uint32_t> objects);

}  // namespace boxstream::papers::volumes
