// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "papers/volumes/point.hpp"

namespace boxstream::papers::volumes {

struct PrincipalAxes {
  Point barycentre;
  Eigen::Matrix3d axes;  ///< columns, orthonormal within rounding, by rising variance of the points along them
};

/// Of the covariance matrix of at least one point. Points that are all the same get some axes.
PrincipalAxes principal_axes(Points points);

}  // namespace boxstream::papers::volumes
