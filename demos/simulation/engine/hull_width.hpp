// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// How thin the convex hull of points is: the least distance of two parallel planes that have it between them, however
/// it is turned. Never too large; too small by 3e-4 of the hull's diagonal at most, by a few per cent where it has more
/// than 128 corners. 0 if the points lie in one plane, or nearly so.
double hull_width(const std::vector<Vec3>& points);

}  // namespace boxstream::scenes
