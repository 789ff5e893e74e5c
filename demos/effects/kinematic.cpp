// SPDX-License-Identifier: MIT
#include <LinearMath/btTransformUtil.h>

#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"
#include "engine/convert.hpp"
#include "engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_body(subject, [](const Body& body) -> std::string {
    return body.traits.type == BodyType::kinematic ? "a kinematic body" : "";
  });
}

void prepare(const Subject&, WorldRecipe& recipe) {
  recipe.move_kinematic = true;
}

void dress(const Subject&, const Body& description, btRigidBody& body) {
  if (description.traits.type == BodyType::kinematic) body.setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
}

/// A kinematic body goes on with the velocities that it starts with.
struct Moved {
  btRigidBody* body;
  btVector3 velocity, spin;
};

void start(Stage& stage) {
  std::vector<Moved> moved;
  for (std::size_t i = 0; i < stage.bodies.size(); ++i)
    if (const Body& body = stage.expanded.bodies[i]; body.traits.type == BodyType::kinematic)
      moved.push_back({stage.bodies[i].get(), vector(body.velocity), vector(body.spin)});
  if (moved.empty()) return;
  stage.before_substep(effects::kinematic, [moved](double dt) {
    for (const Moved& m : moved) {
      btTransform next;
      btTransformUtil::integrateTransform(m.body->getWorldTransform(), m.velocity, m.spin, real(dt), next);
      m.body->setWorldTransform(next);
    }
  });
}

}  // namespace

const Effect kinematic{"kinematic",
                       "bodies that move as they are told",
                       "saveKinematicState, and a hook before each substep",
                       called_for,
                       prepare,
                       dress,
                       start};

}  // namespace boxstream::effects
