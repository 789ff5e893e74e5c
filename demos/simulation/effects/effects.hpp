// SPDX-License-Identifier: MIT
#pragma once

#include "simulation/effects/effect.hpp"

/// Every effect, in the order in which they are built. Here they are registered, and nowhere else. Of what acts before
/// substeps, buoyancy comes after what else slows bodies down: see field_kit.hpp.
#define BOXSTREAM_EFFECTS                                                                                            \
  gravity, tumbling_gravity, contacts, friction, anisotropic_friction, rolling_friction, spinning_friction,          \
      friction_caching, restitution, split_impulse, damping, ccd, sleeping, forced_boxes, gyroscopic, kinematic,     \
      planes, meshes, heightfields, compounds, internal_edges, joints, joint_limits, motors, sensors, characters,    \
      soft_bodies, vehicles, vortex, wind, drag, buoyancy, impulses, respawn, out_of_bounds, collision_filters,      \
      exclusions, queries, monitors, recording, threads, ccd_on_demand, conveyors, other_solver, bounces_on_contact, \
      unit_contacts, multibodies

namespace boxstream::effects {

extern const Effect BOXSTREAM_EFFECTS;

}  // namespace boxstream::effects
