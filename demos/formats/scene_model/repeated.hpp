// SPDX-License-Identifier: MIT
#pragma once

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

/// The same scene several times, side by side on a square lattice of that pitch in x and z: bodies, joints, sensors,
/// characters, vehicles, soft bodies, queries and excluded pairs of bodies. Planes and fields are everywhere
/// anyway; generators and checks stay as they are, `expect` is dropped, and the bounds grow.
Scene repeated(const Scene& scene, int copies, double pitch);

}  // namespace boxstream::scenes
