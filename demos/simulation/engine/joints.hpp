// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "formats/scene_model/joints.hpp"

class btRigidBody;
class btTypedConstraint;

namespace boxstream::scenes {

/// The constraint that a joint asks for, between two bodies where they are now; `b` is null for the world.
/// `dt` is the length of the steps that the engine takes. Not yet in a world. Limits and motors are part of it.
std::unique_ptr<btTypedConstraint> make_joint(const JointValue& joint, btRigidBody& a, btRigidBody* b, double dt);

}  // namespace boxstream::scenes
