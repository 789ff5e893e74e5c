// SPDX-License-Identifier: MIT
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"

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

std::string reason_of(const Subject& subject, const Body& body) {
  if (!is_dynamic(body)) return {};
  if (body.traits.gyro) return *body.traits.gyro == Gyro::off ? "" : "given";
  if (body.spin == Vec3{} || is_round(body, subject.expanded.shapes[body.traits.shape].value)) return {};
  return "a spinning body with unequal moments of inertia";
}

std::optional<Call> calls_for_gyroscopic(const Subject& subject) {
  return first_body(subject, [&](const Body& body) { return reason_of(subject, body); });
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

void dress_gyroscopic(const Subject& subject, const Body& description, btRigidBody& body) {
  if (!reason_of(subject, description).empty())
    body.setFlags(body.getFlags() | flag_of(description.traits.gyro.value_or(Gyro::implicit_body)));
}

}  // namespace

const Effect gyroscopic{"gyroscopic",
                        "spinning bodies tumble and precess",
                        "a gyroscopic torque on those bodies, implicit by default",
                        calls_for_gyroscopic,
                        {.dress = dress_gyroscopic}};

}  // namespace boxstream::effects
