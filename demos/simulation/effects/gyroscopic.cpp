// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <vector>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/tumbler.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

/// Whether a body has the same moment of inertia about all axes, as balls and cubes have.
bool is_round(const Body& body, const ShapeValue& shape) {
  if (body.inertia)
    return body.products == Vec3{} && (*body.inertia)[0] == (*body.inertia)[1] &&
           (*body.inertia)[1] == (*body.inertia)[2];
  if (std::holds_alternative<SphereShape>(shape)) return true;
  const auto* const box = std::get_if<BoxShape>(&shape);
  return box != nullptr && box->half_extents[0] == box->half_extents[1] && box->half_extents[1] == box->half_extents[2];
}

/// Whether the term can be other than zero for a body, if it spins.
bool has_term(const Subject& subject, const Body& body) {
  return is_dynamic(body) && body.traits.gyro != Gyro::off &&
         !is_round(body, subject.expanded.shapes[body.traits.shape].value);
}

/// For each body, what can make it spin; null if nothing can.
std::vector<const char*> causes_of_spin(const Subject& subject) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  const bool is_crowded = !subject.scene.soft_bodies.empty() || !subject.scene.characters.empty();
  const bool turns = std::any_of(subject.scene.fields.begin(), subject.scene.fields.end(), [](const Field& field) {
    return std::holds_alternative<WindField>(field) || std::holds_alternative<DragField>(field) ||
           std::holds_alternative<BuoyancyField>(field);
  });
  const auto any = [](const Body&) { return true; };
  const std::vector<std::uint32_t> all = subject.collidable.count(any);
  std::vector<const char*> causes(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    causes[i] = bodies[i].spin != Vec3{}                                     ? "spins"
                : is_crowded || subject.collidable.partners(i, all, any) > 0 ? "can be hit"
                : turns                                                      ? "can be driven"
                                                                             : nullptr;
  const auto drive = [&](std::size_t body) {
    if (causes[body] == nullptr) causes[body] = "can be driven";
  };
  for (const Joint& joint : subject.expanded.joints) {
    drive(joint.a);
    if (joint.b) drive(*joint.b);
  }
  for (const Vehicle& vehicle : subject.scene.vehicles) drive(vehicle.chassis);
  return causes;
}

std::optional<Call> calls_for_gyroscopic(const Subject& subject) {
  const std::vector<const char*> causes = causes_of_spin(subject);
  return first_body_at(subject, [&](std::size_t i) -> std::string {
    const Body& body = subject.expanded.bodies[i];
    // Multibodies have it by themselves.
    if (!has_term(subject, body) || subject.trees.has_body(i)) return {};
    if (body.traits.gyro) return "given";
    return causes[i] == nullptr ? "" : fmt::format("has unequal moments of inertia and {}", causes[i]);
  });
}

int flag_of(Gyro gyro) {
  switch (gyro) {
    case Gyro::off:
    case Gyro::conserving:
      return 0;
    case Gyro::explicit_step:
      return BT_ENABLE_GYROSCOPIC_FORCE_EXPLICIT;
    case Gyro::implicit_world:
      return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_WORLD;
    case Gyro::implicit_body:
      return BT_ENABLE_GYROSCOPIC_FORCE_IMPLICIT_BODY;
  }
  return 0;
}

/// For all that can have it, not only for those that call for it: it is zero while nothing makes them spin, and should
/// something do so that was not thought of, it shows.
void start_gyroscopic(SceneInstance& instance) {
  auto tumblers = std::make_shared<std::vector<Tumbler>>();
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    const Body& description = instance.expanded.bodies[i];
    btRigidBody& body = *instance.bodies[i];
    if (!has_term(instance.subject, description) || instance.subject.trees.has_body(i)) continue;
    const Gyro gyro = description.traits.gyro.value_or(Gyro::conserving);
    body.setFlags(body.getFlags() | flag_of(gyro));
    if (gyro == Gyro::conserving && Tumbler::can_turn(body)) tumblers->emplace_back(body);
  }
  if (tumblers->empty()) return;
  instance.before_solver(gyroscopic, [tumblers](double dt) {
    for (Tumbler& tumbler : *tumblers) tumbler.before_solver(dt);
  });
  instance.before_motion(gyroscopic, [tumblers](double dt) {
    for (Tumbler& tumbler : *tumblers) tumbler.before_motion(dt);
  });
  instance.after_motion(gyroscopic, [tumblers](double) {
    for (Tumbler& tumbler : *tumblers) tumbler.after_motion();
  });
}

std::uint64_t count_tumbling(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    const btRigidBody& body = *instance.bodies[i];
    count += body.isInWorld() && body.isActive() && !instance.subject.trees.has_body(i) &&
             has_term(instance.subject, instance.expanded.bodies[i]) && !body.getAngularVelocity().isZero();
  }
  return count;
}

}  // namespace

const Effect gyroscopic{"gyroscopic",
                        "spinning bodies tumble and precess",
                        "Euler's equations of those bodies around the solver, or one of Bullet's gyroscopic torques",
                        calls_for_gyroscopic,
                        {.start = start_gyroscopic},
                        {"spinning bodies", count_tumbling}};

}  // namespace boxstream::effects
