// SPDX-License-Identifier: MIT
#pragma once

#include "formats/geometry/solid.hpp"
#include "formats/scene_model/expand.hpp"

namespace boxstream::witnesses {

struct Weight {
  double mass = 0;
  scenes::Vec3 centre{};                            // of mass, in the coordinates of the shape
  geometry::Tensor inertia = geometry::no_inertia;  // about that, along the axes of the shape
};

/// Of a dynamic body, by the solid that its shape encloses, unless the scene says otherwise.
Weight weight_of(const scenes::Expanded& expanded, const scenes::Body& body);

}  // namespace boxstream::witnesses
