// SPDX-License-Identifier: MIT
#pragma once

#include "formats/geometry/solid.hpp"

/// Solids that have formulas. All are centred on the origin as scenes have them, round ones along y.
namespace boxstream::geometry {

Solid box(const Vec3& half_extents);
Solid ball(double radius);
Solid cylinder(double radius, double height);

/// `height` is between the centres of the end spheres.
Solid capsule(double radius, double height);

/// Halfway between base and apex is the origin; a quarter of the height above the base is the centre of mass.
Solid cone(double radius, double height);

}  // namespace boxstream::geometry
