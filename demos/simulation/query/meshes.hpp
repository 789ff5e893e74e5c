// SPDX-License-Identifier: MIT
#pragma once

#include "formats/scene_model/scene.hpp"

namespace boxstream::query {

/// A torus about y.
scenes::MeshShape ring_mesh(double radius, double tube, int around, int across);

/// A profile in the shape of an L, `thickness` thick, whose legs have `length`, drawn out along z to `width`.
scenes::MeshShape bracket_mesh(double length, double width, double thickness);

}  // namespace boxstream::query
