// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/point.hpp"

namespace boxstream::papers::volumes {

/// Distance from `p` to the triangle of three corners, which may be on one line or in one point.
double distance_to_triangle(Points corners, const Point& p);

}  // namespace boxstream::papers::volumes
