// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

/// Two bodies that are in each other before the first step.
struct StartOverlap {
  std::uint32_t a, b;  ///< indices of bodies
  double depth;        ///< metres
};

struct StartOverlaps {
  std::vector<StartOverlap> deepest;  ///< the deepest first
  bool all = true;                    ///< false: there were more to look at than are worth the time
};

/// Pairs that can touch and are deeper in each other than steps push apart by velocities. Builds the world of the
/// scene, and asks the narrow phase about pairs of boxes that overlap as deep; of very many, about those that do most.
StartOverlaps overlaps_at_start(const Scene& scene);

}  // namespace boxstream::scenes
