// SPDX-License-Identifier: MIT
// Not Coal: see ../../README.md.
#pragma once

#include "coal/collision_object.h"

namespace coal {

class Box : public CollisionGeometry {
 public:
  Box(CoalScalar, CoalScalar, CoalScalar) {}
};

}  // namespace coal
