// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <LinearMath/btScalar.h>

class btCollisionObject;

namespace boxstream::scenes {

/// Place, rotation and velocities of every object in order, nodes of soft bodies included, as raw numbers.
void collect_state(const std::vector<btCollisionObject*>& objects, std::vector<btScalar>& out);

/// XXH3 of the numbers' bits.
std::uint64_t hash_of(const std::vector<btScalar>& numbers);

}  // namespace boxstream::scenes
