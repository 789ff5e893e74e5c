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

void apply(const BuoyancyField& field, const SceneInstance& instance, const Displacements& bodies, double dt) {
  const btVector3 gravity = instance.world.world().getGravity();
  for_each_moving(instance, [&](std::size_t i, btRigidBody& body) {
    const Volume under = bodies[i]->below(body.getWorldTransform(), field.level);
    if (!(under.size > 0)) return;
    const btVector3 lift = gravity * real(-field.density * under.size);
    body.applyCentralForce(lift);
    // At the middle of what is under.
    body.applyTorque(vector(times(under.moment, 1 / under.size)).cross(lift));
    if (field.drag == 0) return;
    const btScalar rate = real(std::min(field.drag, 1 / dt) * under.size / bodies[i]->volume());
    body.applyCentralForce(body.getLinearVelocity() * (-rate / body.getInvMass()));
    body.applyTorque(body.getInvInertiaTensorWorld().inverse() * body.getAngularVelocity() * -rate);
  });
}

std::optional<Call> calls_for_buoyancy(const Subject& subject) {
  return called_for<BuoyancyField>(subject, "a fluid",
                                   [](const BuoyancyField& field) { return field.density > 0 || field.drag > 0; });
}

void start_buoyancy(SceneInstance& instance) {
  for_each_field<BuoyancyField>(instance, [&](const BuoyancyField& field) {
    instance.before_substep(buoyancy, [&instance, field, bodies = for_each_shape<Displacement>(instance)](double dt) {
      apply(field, instance, bodies, dt);
    });
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
