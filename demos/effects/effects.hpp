// SPDX-License-Identifier: MIT
#pragma once

#include "effects/effect.hpp"

/// Every effect; each is defined in the file of its name.
namespace boxstream::effects {

extern const Effect gravity;
extern const Effect tumbling_gravity;
extern const Effect contacts;
extern const Effect friction;
extern const Effect anisotropic_friction;
extern const Effect rolling_friction;
extern const Effect spinning_friction;
extern const Effect friction_caching;
extern const Effect restitution;
extern const Effect split_impulse;
extern const Effect damping;
extern const Effect ccd;
extern const Effect sleeping;
extern const Effect forced_boxes;
extern const Effect gyroscopic;
extern const Effect kinematic;
extern const Effect planes;
extern const Effect meshes;
extern const Effect heightfields;
extern const Effect compounds;
extern const Effect internal_edges;
extern const Effect joints;
extern const Effect joint_limits;
extern const Effect motors;
extern const Effect sensors;
extern const Effect characters;
extern const Effect soft_bodies;
extern const Effect vehicles;
extern const Effect swirl;
extern const Effect wind;
extern const Effect drag;
extern const Effect buoyancy;
extern const Effect kicks;
extern const Effect rain;
extern const Effect leaving;
extern const Effect collision_filters;
extern const Effect apart;
extern const Effect queries;
extern const Effect observers;
extern const Effect recording;
extern const Effect threads;

}  // namespace boxstream::effects
