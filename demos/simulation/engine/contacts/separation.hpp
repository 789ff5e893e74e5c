// SPDX-License-Identifier: MIT
#pragma once

#include "simulation/engine/contacts/placed_convex.hpp"

namespace boxstream::scenes {

/// Where two convex shapes are nearest, or the shortest way to part them.
struct Separation {
  double distance = 0;  // of the surfaces, roundings included; negative is the depth
  Vec3 normal{};        // from b to a, of length 1
  Vec3 on_b{};          // on the surface of b, in the coordinates that the shapes share
};

/// Lengths count by the smaller of the two, so that shapes of a millimetre are as good as those of a hundred metres.
/// What is farther apart than `reach` may be said to be at any distance above it.
Separation separation(const PlacedConvex& a, const PlacedConvex& b, double reach);

}  // namespace boxstream::scenes
