// SPDX-License-Identifier: MIT
#pragma once

#include "formats/geometry/solid.hpp"
#include "formats/scene_model/bodies.hpp"

namespace boxstream::scenes {

/// What an engine needs of a body that moves: bodies of engines are where their centre of mass is, and have their
/// principal axes.
struct Mass {
  double mass = 0;        // kg
  Vec3 moments{};         // kg m^2, about the axes of `frame`
  geometry::Frame frame;  // centre of mass and principal axes, in the coordinates in which the body is described
};

/// By its solid, as far as the body says nothing of its own. Nothing of a body that is not dynamic, and the frame that
/// it is described in: it moves as it is told.
Mass mass_of(const Body& body, const geometry::Solid& solid);

}  // namespace boxstream::scenes
