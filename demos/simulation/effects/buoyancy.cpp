// SPDX-License-Identifier: MIT
#include <algorithm>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/field_kit.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/submerged.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

using Displacements = std::vector<std::shared_ptr<const Displacement>>;

/// `share` of the body is under.
void slow_down(btRigidBody& body, const BuoyancyField& field, double share, double dt) {
  const btScalar rate = real(std::min(field.drag, 1 / dt) * share);
  body.applyCentralForce(velocity_left(body, dt) * (-rate / body.getInvMass()));
  body.applyTorque(body.getInvInertiaTensorWorld().inverse() * spin_left(body, dt) * -rate);
}

void apply(const std::vector<BuoyancyField>& fluids, const SceneInstance& instance, const Displacements& bodies,
           double dt) {
  const btVector3 gravity = instance.world.world().getGravity();
  for_each_moving(instance, [&](std::size_t i, btRigidBody& body) {
    btVector3 force(0, 0, 0), torque(0, 0, 0);
    for (const BuoyancyField& fluid : fluids) {
      const Volume under = bodies[i]->below(body.getWorldTransform(), fluid.level);
      if (!(under.size > 0)) continue;
      const btVector3 lift = gravity * real(-fluid.density * under.size);
      force += lift;
      // At the middle of what is under.
      torque += vector(times(under.moment, 1 / under.size)).cross(lift);
      if (fluid.drag > 0) slow_down(body, fluid, under.size / bodies[i]->volume(), dt);
    }
    // Last: no drag takes the velocity that a lift gives, for gravity has not acted yet.
    body.applyCentralForce(force);
    body.applyTorque(torque);
  });
}

std::optional<Call> calls_for_buoyancy(const Subject& subject) {
  return called_for<BuoyancyField>(subject, "a fluid",
                                   [](const BuoyancyField& field) { return field.density > 0 || field.drag > 0; });
}

void start_buoyancy(SceneInstance& instance) {
  std::vector<BuoyancyField> fluids;
  for_each_field<BuoyancyField>(instance, [&](const BuoyancyField& field) { fluids.push_back(field); });
  if (fluids.empty()) return;
  instance.before_substep(buoyancy, [&instance, fluids, bodies = for_each_shape<Displacement>(instance)](double dt) {
    apply(fluids, instance, bodies, dt);
  });
}

/// By their boxes.
std::uint64_t count_in_fluid(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for_each_field<BuoyancyField>(instance, [&](const BuoyancyField& field) {
    count += count_moving(instance, [&](const btRigidBody& body) {
      btVector3 low, high;
      body.getAabb(low, high);
      return double{low.y()} < field.level;
    });
  });
  return count;
}

}  // namespace

const Effect buoyancy{"buoyancy",
                      "a fluid lifts what is in it",
                      "two forces and two torques on each body in the fluid, before each substep",
                      calls_for_buoyancy,
                      {.start = start_buoyancy},
                      {"bodies in the fluid", count_in_fluid}};

}  // namespace boxstream::effects
