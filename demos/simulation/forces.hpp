// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "scene/scene.hpp"
#include "simulation/world_objects.hpp"

namespace boxstream::scenes {

/// Applied before each step to all dynamic bodies.
void apply_swirl(const SwirlField& swirl, const std::vector<std::unique_ptr<btRigidBody>>& bodies);

/// Moves a kinematic body on by one step; Bullet works out its velocity from that.
void move_on(const Moved& moved, double dt);

}  // namespace boxstream::scenes
