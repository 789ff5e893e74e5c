// SPDX-License-Identifier: MIT
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

// What materials say: one coefficient each.
namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_friction(const Subject& subject) {
  // Bullet multiplies the two coefficients, so it takes two.
  int rough = 0;
  for (const Body& body : subject.expanded.bodies) rough += body.traits.material.friction > 0;
  rough += static_cast<int>(subject.scene.characters.size() + subject.scene.soft_bodies.size());
  if (rough < 2) return std::nullopt;
  // A soft body has a coefficient of its own, and slides on fixed bodies too.
  const bool soft = !subject.scene.soft_bodies.empty();
  return first_body(subject, [&](const Body& body) {
    const double friction = body.traits.material.friction;
    return (is_dynamic(body) || soft) && friction > 0 ? fmt::format("friction {}", friction) : std::string{};
  });
}

void prepare_friction(const Subject& subject, WorldRecipe& recipe) {
  const FrictionDirections directions = subject.scene.solver.friction_directions;
  recipe.friction = true;
  if (directions != FrictionDirections::one) recipe.solver.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  if (directions == FrictionDirections::two_fixed)
    recipe.solver.m_solverMode |= SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
}

void dress_friction(const Subject&, const Body& description, btRigidBody& body) {
  body.setFriction(real(description.traits.material.friction));
}

std::optional<Call> first_above_zero(const Subject& subject, double Material::*coefficient, const char* name) {
  return first_body(subject, [&](const Body& body) {
    const double value = body.traits.material.*coefficient;
    return value > 0 ? fmt::format("{} {}", name, value) : std::string{};
  });
}

void dress_rolling(const Subject& subject, const Body& description, btRigidBody& body) {
  body.setRollingFriction(real(description.traits.material.rolling));
  // Bullet multiplies it with the other body's coefficient of sliding friction.
  dress_friction(subject, description, body);
}

void dress_spinning(const Subject& subject, const Body& description, btRigidBody& body) {
  constexpr auto faint = btScalar(1e-30);
  body.setSpinningFriction(real(description.traits.material.spinning));
  // Bullet leaves the rows of spinning out where there are none of rolling: these are too weak to roll anything.
  if (description.traits.material.spinning > 0 && body.getRollingFriction() == 0) body.setRollingFriction(faint);
  dress_friction(subject, description, body);
}

std::optional<Call> calls_for_anisotropy(const Subject& subject) {
  return first_body(subject, [](const Body& body) {
    const Vec3& factors = body.traits.material.anisotropic;
    return factors != Vec3{1, 1, 1} ? fmt::format("factors [{}, {}, {}]", factors[0], factors[1], factors[2])
                                    : std::string{};
  });
}

void dress_anisotropy(const Subject&, const Body& description, btRigidBody& body) {
  const Vec3& factors = description.traits.material.anisotropic;
  if (factors != Vec3{1, 1, 1}) body.setAnisotropicFriction(vector(factors));
}

}  // namespace

const Effect friction{"friction",
                      "touching bodies hold each other back",
                      "one or two rows for each contact point",
                      calls_for_friction,
                      {.prepare = prepare_friction, .dress = dress_friction}};

const Effect rolling_friction{"rolling_friction",
                              "rolling bodies slow down",
                              "three rows for each contact",
                              [](const Subject& s) { return first_above_zero(s, &Material::rolling, "rolling"); },
                              {.dress = dress_rolling}};

const Effect spinning_friction{"spinning_friction",
                               "bodies that spin on the spot slow down",
                               "a row for each contact",
                               [](const Subject& s) { return first_above_zero(s, &Material::spinning, "spinning"); },
                               {.dress = dress_spinning}};

const Effect anisotropic_friction{"anisotropic_friction",
                                  "bodies slide more easily one way than another",
                                  "setAnisotropicFriction of those bodies",
                                  calls_for_anisotropy,
                                  {.dress = dress_anisotropy}};

const Effect restitution{"restitution",
                         "bodies bounce",
                         "a coefficient of each body",
                         [](const Subject& s) { return first_above_zero(s, &Material::restitution, "restitution"); },
                         {.dress = [](const Subject&, const Body& description, btRigidBody& body) {
                           body.setRestitution(real(description.traits.material.restitution));
                         }}};

}  // namespace boxstream::effects
