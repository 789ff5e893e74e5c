// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/scene_model/random.hpp"
#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"

// Air and fluids: forces on each dynamic body before each substep. And impulses, which are new velocities.
namespace boxstream::effects {
namespace {

using namespace scenes;

/// Each dynamic body that is in the world and awake, with its index.
template <class Visit>
void for_each_moving(const SceneInstance& instance, Visit visit) {
  for (std::size_t i = 0; i < instance.bodies.size(); ++i) {
    btRigidBody& body = *instance.bodies[i];
    if (!body.isStaticOrKinematicObject() && body.isInWorld() && body.isActive()) visit(i, body);
  }
}

/// Force per speed beyond which a fluid would turn a body round within a substep of `dt` seconds: one that takes on the
/// speed of the fluid at once.
double most_strength(const btRigidBody& body, double dt) {
  return 1 / (double{body.getInvMass()} * dt);
}

/// Each field of the scene that is a T.
template <class T, class Visit>
void for_each_field(const SceneInstance& instance, Visit visit) {
  for (const scenes::Field& field : instance.scene.fields)
    if (const auto* const kind = std::get_if<T>(&field)) visit(*kind);
}

void apply(const VortexField& vortex, const SceneInstance& instance, double dt) {
  const btVector3 centre = vector(vortex.centre);
  const btScalar turns = real(vortex.speed / vortex.radius);
  const btScalar half_turns = real(std::numbers::pi / vortex.height);
  const btScalar strength = real(vortex.updraft / 2);
  const btScalar rate = real(std::min(vortex.rate, 1 / dt));
  for_each_moving(instance, [&](std::size_t, btRigidBody& body) {
    const btVector3 r = body.getWorldTransform().getOrigin() - centre;
    // The convection comes from the stream function strength r^2 (1 - u^2) sin(pi y / height): nothing crosses floor,
    // lid or the cylinder u = 1, and what flows into any volume flows out of it.
    const btScalar u2 = std::min((r.x() * r.x() + r.z() * r.z()) / real(vortex.radius * vortex.radius), btScalar(1));
    const btScalar inwards = strength * (1 - u2) * half_turns * std::cos(half_turns * r.y());
    const btScalar up = strength * (2 - 4 * u2) * std::sin(half_turns * r.y());
    const btVector3 air(-turns * r.z() - inwards * r.x(), up, turns * r.x() - inwards * r.z());
    body.applyCentralForce((air - body.getLinearVelocity()) * (rate / body.getInvMass()));
  });
}

/// Bullet's own takes a sphere for the box around it.
double bounding_radius(const btCollisionShape& shape) {
  if (shape.getShapeType() == SPHERE_SHAPE_PROXYTYPE) return static_cast<const btSphereShape&>(shape).getRadius();
  btVector3 centre;
  btScalar radius;
  shape.getBoundingSphere(centre, radius);
  return radius;
}

void apply(const WindField& field, const SceneInstance& instance, double dt) {
  const btVector3 air = vector(field.velocity);
  for_each_moving(instance, [&](std::size_t, btRigidBody& body) {
    const double radius = bounding_radius(*body.getCollisionShape());
    const btVector3 relative = air - body.getLinearVelocity();
    const double area = std::numbers::pi * radius * radius;
    const double strength = field.density / 2 * field.coefficient * area * relative.length();
    body.applyCentralForce(relative * real(std::min(strength, most_strength(body, dt))));
  });
}

void apply(const DragField& field, const SceneInstance& instance, double dt) {
  for_each_moving(instance, [&](std::size_t, btRigidBody& body) {
    const btVector3 v = body.getLinearVelocity();
    const double strength = field.linear + field.quadratic * v.length();
    body.applyCentralForce(v * -real(std::min(strength, most_strength(body, dt))));
    if (field.angular == 0) return;
    const btVector3& inverse = body.getInvInertiaDiagLocal();
    const double most = 1 / (double{inverse[inverse.maxAxis()]} * dt);
    body.applyTorque(body.getAngularVelocity() * -real(std::min(field.angular, most)));
  });
}

/// Share of a body's bounding box that is below the level.
btScalar share_under(const btRigidBody& body, double level) {
  btVector3 low, high;
  body.getAabb(low, high);
  return std::clamp((real(level) - low.y()) / std::max(high.y() - low.y(), btScalar(1e-6)), btScalar(0), btScalar(1));
}

void apply(const BuoyancyField& field, const SceneInstance& instance, double dt) {
  for_each_moving(instance, [&](std::size_t i, btRigidBody& body) {
    const btScalar under = share_under(body, field.level);
    if (under == 0) return;
    const btScalar displaced = under * real(field.density * instance.built(i).volume);
    body.applyCentralForce(instance.world.world().getGravity() * -displaced);
    const btScalar rate = under * real(std::min(field.drag, 1 / dt));
    body.applyCentralForce(body.getLinearVelocity() * (-rate / body.getInvMass()));
    body.applyTorque(body.getInvInertiaTensorWorld().inverse() * body.getAngularVelocity() * -rate);
  });
}

void start_impulses(SceneInstance& instance) {
  std::vector<std::size_t> dynamic;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i)
    if (is_dynamic(instance.expanded.bodies[i])) dynamic.push_back(i);
  if (dynamic.empty()) return;
  std::uint64_t stream = 0;
  for_each_field<ImpulsesField>(instance, [&](const ImpulsesField& field) {
    const auto count = static_cast<std::size_t>(std::ceil(field.share * static_cast<double>(dynamic.size())));
    Random random(instance.scene.world.seed + 0x517cc1b727220a95u * ++stream);
    instance.before_step(impulses, [&instance, field, dynamic, count, random, next = std::size_t{0}](double) mutable {
      for (std::size_t k = 0; k < count; ++k, next = (next + 1) % dynamic.size()) {
        btRigidBody& body = *instance.bodies[dynamic[next]];
        body.setLinearVelocity(vector(random.in_ball(field.speed)));
        body.activate();
        ++instance.impulses;
      }
    });
  });
}

// Whether a field can change the velocity of any body.

bool acts(const VortexField& vortex) {
  return vortex.rate > 0;
}
bool acts(const WindField& wind) {
  return wind.density > 0 && wind.coefficient > 0;
}
bool acts(const DragField& drag) {
  return drag.linear > 0 || drag.quadratic > 0 || drag.angular > 0;
}
bool acts(const BuoyancyField& buoyancy) {
  return buoyancy.density > 0 || buoyancy.drag > 0;
}
bool acts(const ImpulsesField&) {
  return true;
}

template <class T>
std::optional<Call> called_for(const Subject& subject, const char* reason) {
  const std::vector<scenes::Field>& fields = subject.scene.fields;
  if (!has_dynamic(subject)) return std::nullopt;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (const auto* const field = std::get_if<T>(&fields[i]); field != nullptr && acts(*field))
      return Call{fmt::format("/fields/{}", i), reason};
  return std::nullopt;
}

template <class T, const Effect& effect>
void start_field(SceneInstance& instance) {
  for_each_field<T>(instance, [&](const T& field) {
    instance.before_substep(effect, [&instance, field](double dt) { apply(field, instance, dt); });
  });
}

constexpr const char* a_force = "a force on each dynamic body before each substep";

template <class T>
std::uint64_t count_pushed(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for_each_field<T>(instance, [&](const T&) { count += count_moving(instance); });
  return count;
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

std::uint64_t count_in_fluid(const SceneInstance& instance) {
  std::uint64_t count = 0;
  for_each_field<BuoyancyField>(instance, [&](const BuoyancyField& field) {
    count += count_moving(instance, [&](const btRigidBody& body) { return share_under(body, field.level) > 0; });
  });
  return count;
}

std::uint64_t count_impulses(const SceneInstance& instance) {
  return instance.impulses;
}

}  // namespace

const Effect vortex{"swirl",
                    "air drags bodies round and round",
                    a_force,
                    [](const Subject& subject) { return called_for<VortexField>(subject, "swirling air"); },
                    {.start = start_field<VortexField, vortex>},
                    {"bodies", count_pushed<VortexField>}};

const Effect wind{"wind",
                  "moving air pushes bodies",
                  a_force,
                  [](const Subject& subject) { return called_for<WindField>(subject, "wind"); },
                  {.start = start_field<WindField, wind>},
                  {"bodies", count_pushed<WindField>}};

const Effect drag{"drag",
                  "a fluid that is everywhere slows bodies down",
                  a_force,
                  [](const Subject& subject) { return called_for<DragField>(subject, "drag"); },
                  {.start = start_field<DragField, drag>},
                  {"bodies", count_slowed}};

const Effect buoyancy{"buoyancy",
                      "a fluid lifts what is in it",
                      "two forces and a torque on each body in the fluid, before each substep",
                      [](const Subject& subject) { return called_for<BuoyancyField>(subject, "a fluid"); },
                      {.start = start_field<BuoyancyField, buoyancy>},
                      {"bodies in the fluid", count_in_fluid}};

const Effect impulses{"kicks",
                      "bodies get a new velocity in turn",
                      "setLinearVelocity of a share of the bodies before each step",
                      [](const Subject& subject) { return called_for<ImpulsesField>(subject, "new velocities"); },
                      {.start = start_impulses},
                      {"impulses", count_impulses, Effect::Activity::of_run}};

}  // namespace boxstream::effects
