// SPDX-License-Identifier: MIT
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "engine/convert.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
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

void prepare(const Subject& subject, WorldRecipe& recipe) {
  const FrictionDirections directions = subject.scene.solver.friction_directions;
  recipe.friction = true;
  if (directions != FrictionDirections::one) recipe.solver.m_solverMode |= SOLVER_USE_2_FRICTION_DIRECTIONS;
  if (directions == FrictionDirections::two_fixed)
    recipe.solver.m_solverMode |= SOLVER_DISABLE_VELOCITY_DEPENDENT_FRICTION_DIRECTION;
}

void dress(const Subject&, const Body& description, btRigidBody& body) {
  body.setFriction(real(description.traits.material.friction));
}

}  // namespace

const Effect friction{
    "friction", "touching bodies hold each other back", "one or two rows for each contact point", called_for, prepare,
    dress};

}  // namespace boxstream::effects
