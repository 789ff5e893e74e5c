// SPDX-License-Identifier: MIT
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

// What materials say: one coefficient each.
namespace boxstream::effects {
namespace {

using namespace scenes;

// Bullet multiplies coefficients of the two bodies of a contact, so each effect takes two.

template <double Material::*coefficient>
bool has(const Body& body) {
  return body.traits.material.*coefficient > 0;
}

template <double Material::*coefficient>
std::string value_of(const Body& body, const char* name) {
  return fmt::format("{} {}", name, body.traits.material.*coefficient);
}

constexpr auto is_rough = has<&Material::friction>;

/// Whether a body can touch a soft one. Those have a coefficient of their own, and slide on fixed bodies too.
bool meets_soft_body(const Subject& subject, std::size_t body) {
  return !subject.scene.soft_bodies.empty() &&
         subject.collidable.meets_other(body, btBroadphaseProxy::DefaultFilter,
                                        static_cast<std::uint32_t>(btBroadphaseProxy::AllFilter));
}

/// The first body with `one(index)` that can touch something rough: another body, or a character.
template <class One, class Reason>
std::optional<Call> first_on_something_rough(const Subject& subject, One one, Reason reason) {
  const std::vector<std::uint32_t> rough = subject.collidable.count(is_rough);
  return first_body_at(subject, [&](std::size_t i) -> std::string {
    if (!one(i)) return {};
    const bool rubs = subject.collidable.partners(i, rough, is_rough) > 0 || meets_character(subject, i);
    return rubs ? reason(subject.expanded.bodies[i]) : "";
  });
}

/// The same for a coefficient that is multiplied by the friction of the other one.
template <double Material::*coefficient>
std::optional<Call> first_that_rubs(const Subject& subject, const char* name) {
  return first_on_something_rough(
      subject, [&](std::size_t i) { return has<coefficient>(subject.expanded.bodies[i]); },
      [&](const Body& body) { return value_of<coefficient>(body, name); });
}

std::optional<Call> calls_for_friction(const Subject& subject) {
  const auto reason = [](const Body& body) { return value_of<&Material::friction>(body, "friction"); };
  if (!subject.scene.soft_bodies.empty())
    if (auto call = first_body_at(subject, [&](std::size_t i) -> std::string {
          const Body& body = subject.expanded.bodies[i];
          return is_rough(body) && meets_soft_body(subject, i) ? reason(body) : "";
        }))
      return call;
  return first_on_something_rough(
      subject,
      [&](std::size_t i) { return is_dynamic(subject.expanded.bodies[i]) && is_rough(subject.expanded.bodies[i]); },
      reason);
}

void prepare_friction(const Subject& subject, WorldRecipe& recipe) {
  const FrictionDirections directions = subject.scene.solver.friction_directions;
  recipe.friction = true;
  if (directions != FrictionDirections::one) recipe.solver.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  if (directions == FrictionDirections::two_fixed)
    recipe.solver.m_solverMode |= SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
}

void configure_friction(const Subject&, const Body& description, btRigidBody& body) {
  body.setFriction(real(description.traits.material.friction));
}

std::optional<Call> calls_for_rolling(const Subject& subject) {
  return first_that_rubs<&Material::rolling>(subject, "rolling");
}

void configure_rolling(const Subject& subject, const Body& description, btRigidBody& body) {
  body.setRollingFriction(real(description.traits.material.rolling));
  // Rows of rolling take the coefficient of sliding friction of the other body.
  configure_friction(subject, description, body);
}

std::optional<Call> calls_for_spinning(const Subject& subject) {
  return first_that_rubs<&Material::spinning>(subject, "spinning");
}

void configure_spinning(const Subject& subject, const Body& description, btRigidBody& body) {
  constexpr auto faint = btScalar(1e-30);
  body.setSpinningFriction(real(description.traits.material.spinning));
  // Bullet leaves the rows of spinning out where there are none of rolling: these are too weak to roll anything.
  if (description.traits.material.spinning > 0 && body.getRollingFriction() == 0) body.setRollingFriction(faint);
  configure_friction(subject, description, body);
}

std::optional<Call> calls_for_anisotropy(const Subject& subject) {
  const auto has_factors = [&](std::size_t i) {
    const Body& body = subject.expanded.bodies[i];
    return is_rough(body) && body.traits.material.anisotropic != Vec3{1, 1, 1};
  };
  return first_on_something_rough(subject, has_factors, [](const Body& body) {
    const Vec3& factors = body.traits.material.anisotropic;
    return fmt::format("factors [{}, {}, {}]", factors[0], factors[1], factors[2]);
  });
}

void configure_anisotropy(const Subject&, const Body& description, btRigidBody& body) {
  const Vec3& factors = description.traits.material.anisotropic;
  if (factors != Vec3{1, 1, 1}) body.setAnisotropicFriction(vector(factors));
}

std::optional<Call> calls_for_restitution(const Subject& subject) {
  return first_meeting(subject, has<&Material::restitution>, has<&Material::restitution>,
                       [](const Body& body) { return value_of<&Material::restitution>(body, "restitution"); });
}

void configure_restitution(const Subject&, const Body& description, btRigidBody& body) {
  body.setRestitution(real(description.traits.material.restitution));
}

using Object = btCollisionObject;

bool is_held(const btManifoldPoint& point) {
  return point.m_appliedImpulseLateral1 != 0 || point.m_appliedImpulseLateral2 != 0;
}

std::uint64_t count_friction(const SceneInstance& instance) {
  return count_points(instance,
                      [](const btManifoldPoint& point, const Object&, const Object&) { return is_held(point); }) +
         count_soft_points(instance, [](const btSoftBody& soft, const Object& object) {
           return soft.m_cfg.kDF * object.getFriction() > 0;
         });
}

std::uint64_t count_anisotropy(const SceneInstance& instance) {
  return count_points(instance, [](const btManifoldPoint& point, const Object& a, const Object& b) {
    return is_held(point) && (a.hasAnisotropicFriction() || b.hasAnisotropicFriction());
  });
}

/// Points that part: Bullet takes speeds below its threshold for rest.
std::uint64_t count_bounces(const SceneInstance& instance) {
  const btScalar threshold = instance.world.world().getSolverInfo().m_restitutionVelocityThreshold;
  const auto velocity = [&](const Object& object, const btVector3& at) {
    const auto index = static_cast<std::size_t>(object.getUserIndex());
    const btRigidBody* const body = index < instance.bodies.size() ? instance.bodies[index].get() : nullptr;
    return body == nullptr ? btVector3(0, 0, 0) : body->getVelocityInLocalPoint(at - body->getCenterOfMassPosition());
  };
  return count_points(instance, [&](const btManifoldPoint& point, const Object& a, const Object& b) {
    if (point.m_combinedRestitution == 0) return false;
    const btVector3 parting = velocity(a, point.m_positionWorldOnA) - velocity(b, point.m_positionWorldOnB);
    return parting.dot(point.m_normalWorldOnB) > point.m_combinedRestitution * threshold / 2;
  });
}

}  // namespace

const Effect friction{"friction",
                      "touching bodies hold each other back",
                      "one or two rows for each contact point",
                      calls_for_friction,
                      {.prepare = prepare_friction, .configure_body = configure_friction},
                      {"contact points", count_friction}};

const Effect rolling_friction{"rolling_friction",
                              "rolling bodies slow down",
                              "three rows for each contact",
                              calls_for_rolling,
                              {.configure_body = configure_rolling},
                              {"rows", count_rows<&SolverRows::acting_rolling>, Effect::Activity::of_run}};

const Effect spinning_friction{"spinning_friction",
                               "bodies that spin on the spot slow down",
                               "a row for each contact",
                               calls_for_spinning,
                               {.configure_body = configure_spinning},
                               {"rows", count_rows<&SolverRows::acting_spinning>, Effect::Activity::of_run}};

const Effect anisotropic_friction{
    "anisotropic_friction", "bodies slide more easily one way than another", "setAnisotropicFriction of those bodies",
    calls_for_anisotropy,   {.configure_body = configure_anisotropy},        {"contact points", count_anisotropy}};

const Effect restitution{"restitution",
                         "bodies bounce",
                         "a coefficient of each body",
                         calls_for_restitution,
                         {.configure_body = configure_restitution},
                         {"contact points", count_bounces}};

}  // namespace boxstream::effects
