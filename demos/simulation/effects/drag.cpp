// SPDX-License-Identifier: MIT
#include <algorithm>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/field_kit.hpp"
#include "simulation/effects/flow.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

bool acts_by_area(const DragField& field) {
  return field.density > 0 && field.coefficient > 0;
}

bool acts_alike(const DragField& field) {
  return field.linear > 0 || field.quadratic > 0 || field.angular > 0;
}

/// The same for all bodies.
void apply(const DragField& field, const SceneInstance& instance, double dt) {
  for_each_moving(instance, [&](std::size_t, btRigidBody& body) {
    const btVector3 v = velocity_left(body, dt);
    const double strength = field.linear + field.quadratic * v.length();
    body.applyCentralForce(v * -real(std::min(strength, most_strength(body, dt))));
    if (field.angular == 0) return;
    const btVector3& inverse = body.getInvInertiaDiagLocal();
    const double most = 1 / (double{inverse[inverse.maxAxis()]} * dt);
    body.applyTorque(spin_left(body, dt) * -real(std::min(field.angular, most)));
  });
}

std::optional<Call> calls_for_drag(const Subject& subject) {
  return called_for<DragField>(subject, "drag",
                               [](const DragField& field) { return acts_alike(field) || acts_by_area(field); });
}

void start_drag(SceneInstance& instance) {
  for_each_field<DragField>(instance, [&](const DragField& field) {
    if (acts_alike(field)) instance.before_substep(drag, [&instance, field](double dt) { apply(field, instance, dt); });
    if (!acts_by_area(field)) return;
    const Flow flow(instance, btVector3(0, 0, 0), field.density, field.coefficient);
    instance.before_substep(drag, [flow](double dt) { flow.push(dt); });
  });
}

std::uint64_t count_slowed(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for_each_field<DragField>(instance, [&](const DragField&) {
    count += count_moving(instance, [](const btRigidBody& body) {
      return !body.getLinearVelocity().isZero() || !body.getAngularVelocity().isZero();
    });
  });
  return count;
}

}  // namespace

const Effect drag{"drag",
                  "a fluid that is everywhere slows bodies down",
                  a_force,
                  calls_for_drag,
                  {.start = start_drag},
                  {"bodies", count_slowed}};

}  // namespace boxstream::effects
