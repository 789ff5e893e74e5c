// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

class btCollisionWorld;

namespace boxstream::scenes {

/// Casts the rays, turned as far as they are after so many steps, and returns how many hit something.
std::uint64_t cast_rays(const RayFan& fan, std::uint64_t step, const btCollisionWorld& world);

}  // namespace boxstream::scenes
