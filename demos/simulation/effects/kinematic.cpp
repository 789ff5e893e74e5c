// SPDX-License-Identifier: MIT
#include <LinearMath/btTransformUtil.h>

#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_kinematic(const Subject& subject) {
  return first_body(subject, [](const Body& body) -> std::string {
    return body.traits.type == BodyType::kinematic ? "a kinematic body" : "";
  });
}

void prepare_kinematic(const Subject&, WorldRecipe& recipe) {
  recipe.move_kinematic = true;
}

void configure_kinematic(const Subject&, const Body& description, btRigidBody& body) {
  if (description.traits.type == BodyType::kinematic) body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
}

/// A kinematic body goes on with the velocities that it starts with.
struct Moved {
  btRigidBody* body;
  btVector3 velocity, spin;
};

void start_kinematic(SceneInstance& instance) {
  std::vector<Moved> moved;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i)
    if (const Body& body = instance.expanded.bodies[i]; body.traits.type == BodyType::kinematic)
      moved.push_back({instance.bodies[i].get(), vector(body.velocity), vector(body.spin)});
  if (moved.empty()) return;
  instance.before_substep(effects::kinematic, [moved](double dt) {
    for (const Moved& m : moved) {
      btTransform next;
      btTransformUtil::integrateTransform(m.body->getWorldTransform(), m.velocity, m.spin, real(dt), next);
      m.body->setWorldTransform(next);
    }
  });
}

std::uint64_t count_moved(const SceneInstance& instance) {
  return static_cast<std::uint64_t>(std::count_if(instance.bodies.begin(), instance.bodies.end(), [](const auto& body) {
    return body->isKinematicObject() && (!body->getLinearVelocity().isZero() || !body->getAngularVelocity().isZero());
  }));
}

}  // namespace

const Effect kinematic{"kinematic",
                       "bodies that move as prescribed",
                       "saveKinematicState, and a hook before each substep",
                       calls_for_kinematic,
                       {.prepare = prepare_kinematic, .configure_body = configure_kinematic, .start = start_kinematic},
                       {"moving bodies", count_moved}};

}  // namespace boxstream::effects
