// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <vector>

#include "pictures/viewer/model.hpp"

namespace boxstream::view {

/// Half extents of each object in its own coordinates, where it is one box, cylinder, cone or capsule that stands in
/// its middle and is not turned there; zero for all others.
std::vector<Point> lone_halves(const Model& model);

/// Half extents, in lengths of the world, of the upright box around a box of these halves that is turned by the
/// quaternion `q`, of any length. Without cosines, so that every machine comes to the same.
std::array<double, 3> upright_halves(const Point& halves, const std::array<double, 4>& q);

}  // namespace boxstream::view
