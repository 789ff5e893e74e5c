// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/plan.hpp"

namespace boxstream::effects {

const std::vector<const Effect*>& all_effects() {
  static const std::vector<const Effect*> effects{&gravity,
                                                  &tumbling_gravity,
                                                  &contacts,
                                                  &friction,
                                                  &anisotropic_friction,
                                                  &rolling_friction,
                                                  &spinning_friction,
                                                  &friction_caching,
                                                  &restitution,
                                                  &split_impulse,
                                                  &damping,
                                                  &ccd,
                                                  &sleeping,
                                                  &forced_boxes,
                                                  &gyroscopic,
                                                  &kinematic,
                                                  &planes,
                                                  &meshes,
                                                  &heightfields,
                                                  &compounds,
                                                  &internal_edges,
                                                  &joints,
                                                  &joint_limits,
                                                  &motors,
                                                  &sensors,
                                                  &characters,
                                                  &soft_bodies,
                                                  &vehicles,
                                                  &swirl,
                                                  &wind,
                                                  &drag,
                                                  &buoyancy,
                                                  &kicks,
                                                  &rain,
                                                  &leaving,
                                                  &collision_filters,
                                                  &apart,
                                                  &queries,
                                                  &observers,
                                                  &recording,
                                                  &threads};
  return effects;
}

}  // namespace boxstream::effects
