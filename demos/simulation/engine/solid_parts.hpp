// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <LinearMath/btTransform.h>

#include "simulation/engine/bullet_shapes.hpp"

namespace boxstream::scenes {

/// A solid of one kind, and its pose in the body that it is a part of.
struct SolidPart {
  const ShapeValue* shape;     // no compound, and nothing that only fixed bodies have
  const geometry::Hull* hull;  // of one of points; else null
  btTransform pose;
};

/// What a body of a shape consists of: the shape itself, or the parts of a compound. `frame` is the pose of the shape
/// in the body. The result points into `shapes`.
std::vector<SolidPart> solid_parts(ShapeSet& shapes, std::size_t shape, const btTransform& frame);

/// Largest distance of a point of a part from its own origin, in metres.
double reach(const SolidPart& part);

/// The surface of a box or a hull as triangles, counter-clockwise seen from outside, in the frame of the body. Other
/// parts have none.
struct Facets {
  std::vector<btVector3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
Facets facets(const SolidPart& part);

}  // namespace boxstream::scenes
