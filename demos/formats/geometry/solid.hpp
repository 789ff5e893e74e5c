// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/geometry/principal.hpp"

namespace boxstream::geometry {

/// Mass, centre of mass and inertia of a body of density 1.
struct Solid {
  double volume = 0;  // negative if the triangles are clockwise seen from outside; so is `inertia` then
  Vec3 centroid{};
  Tensor inertia = no_inertia;  // about the centroid, along the axes
};

/// Of the volume that closed triangles enclose.
Solid measure(const std::vector<Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles);

/// The same solid, turned and moved.
Solid placed(const Frame& place, const Solid& solid);

/// Of several together; where they overlap, each counts.
Solid sum(const std::vector<Solid>& solids);

/// Whether every edge belongs to as many triangles in one direction as in the other.
bool is_closed(const std::vector<std::array<std::uint32_t, 3>>& triangles);

// Solids that have formulas. All are centred on the origin as scenes have them, round ones along y.

Solid box(const Vec3& half_extents);
Solid ball(double radius);
Solid cylinder(double radius, double height);

/// `height` is between the centres of the end spheres.
Solid capsule(double radius, double height);

/// Halfway between base and apex is the origin; a quarter of the height above the base is the centre of mass.
Solid cone(double radius, double height);

}  // namespace boxstream::geometry
