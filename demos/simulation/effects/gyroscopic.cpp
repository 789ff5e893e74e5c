// SPDX-License-Identifier: MIT
#include <algorithm>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

/// Whether a body has the same moment of inertia about all axes, as balls and cubes have.
bool is_round(const Body& body, const ShapeValue& shape) {
  if (body.inertia) return (*body.inertia)[0] == (*body.inertia)[1] && (*body.inertia)[1] == (*body.inertia)[2];
  if (std::holds_alternative<SphereShape>(shape)) return true;
  const auto* const box = std::get_if<BoxShape>(&shape);
  return box != nullptr && box->half_extents[0] == box->half_extents[1] && box->half_extents[1] == box->half_extents[2];
}

/// For each body, what can make it spin; null if nothing can.
std::vector<const char*> causes_of_spin(const Subject& subject) {
  const std::vector<Body>& bodies = subject.expanded.bodies;
  const bool is_crowded = !subject.scene.soft_bodies.empty() || !subject.scene.characters.empty();
  const bool turns = std::any_of(subject.scene.fields.begin(), subject.scene.fields.end(), [](const Field& field) {
    return std::holds_alternative<DragField>(field) || std::holds_alternative<BuoyancyField>(field);
  });
  const auto any = [](const Body&) { return true; };
  const std::vector<std::uint32_t> all = subject.meetings.count(any);
  std::vector<const char*> causes(bodies.size());
  for (std::size_t i = 0; i < bodies.size(); ++i)
    causes[i] = bodies[i].spin != Vec3{}                                   ? "spins"
                : is_crowded || subject.meetings.partners(i, all, any) > 0 ? "can be hit"
                : turns                                                    ? "can be driven"
                                                                           : nullptr;
  for (const Joint& joint : subject.expanded.joints) {
    if (causes[joint.a] == nullptr) causes[joint.a] = "can be driven";
    if (joint.b && causes[*joint.b] == nullptr) causes[*joint.b] = "can be driven";
  }
  return causes;
}

std::string reason_of(const Subject& subject, const Body& body, const char* cause) {
  if (!is_dynamic(body)) return {};
  if (body.traits.gyro) return *body.traits.gyro == Gyro::off ? "" : "given";
  if (cause == nullptr || is_round(body, subject.expanded.shapes[body.traits.shape].value)) return {};
  return fmt::format("has unequal moments of inertia and {}", cause);
}

std::optional<Call> calls_for_gyroscopic(const Subject& subject) {
  const std::vector<const char*> causes = causes_of_spin(subject);
  return first_body_at(subject,
                       [&](std::size_t i) { return reason_of(subject, subject.expanded.bodies[i], causes[i]); });
}

int flag_of(Gyro gyro) {
  switch (gyro) {
    case Gyro::off:
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

void start_gyroscopic(SceneInstance& instance) {
  const std::vector<const char*> causes = causes_of_spin(instance.subject);
  for (std::size_t i = 0; i < causes.size(); ++i) {
    const Body& description = instance.expanded.bodies[i];
    btRigidBody& body = *instance.bodies[i];
    if (!reason_of(instance.subject, description, causes[i]).empty())
      body.setFlags(body.getFlags() | flag_of(description.traits.gyro.value_or(Gyro::implicit_body)));
  }
}

std::uint64_t count_tumbling(const SceneInstance& instance) {
  return count_moving(
      instance, [](const btRigidBody& body) { return body.getFlags() != 0 && !body.getAngularVelocity().isZero(); });
}

}  // namespace

const Effect gyroscopic{"gyroscopic",
                        "spinning bodies tumble and precess",
                        "a gyroscopic torque on those bodies, implicit by default",
                        calls_for_gyroscopic,
                        {.start = start_gyroscopic},
                        {"spinning bodies", count_tumbling}};

}  // namespace boxstream::effects
