// SPDX-License-Identifier: MIT
#pragma once

#include "formats/geometry/convex_hull.hpp"
#include "formats/geometry/frame.hpp"
#include "formats/geometry/principal.hpp"
#include "formats/geometry/solid.hpp"

namespace boxstream::imports {

using namespace geometry;

}  // namespace boxstream::imports
