// SPDX-License-Identifier: MIT
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_damping(const Subject& subject) {
  return first_body(subject, [](const Body& body) {
    const BodyTraits& traits = body.traits;
    if (!is_dynamic(body)) return std::string{};
    if (traits.linear_damping > 0) return fmt::format("linear_damping {}", traits.linear_damping);
    if (traits.angular_damping > 0) return fmt::format("angular_damping {}", traits.angular_damping);
    return std::string{};
  });
}

void prepare_damping(const Subject&, WorldRecipe& recipe) {
  recipe.apply_damping = true;
}

void configure_damping(const Subject&, const Body& description, btRigidBody& body) {
  body.setDamping(real(description.traits.linear_damping), real(description.traits.angular_damping));
}

std::uint64_t count_damped(const SceneInstance& instance) {
  return count_moving(instance, [](const btRigidBody& body) {
    return (body.getLinearDamping() > 0 && !body.getLinearVelocity().isZero()) ||
           (body.getAngularDamping() > 0 && !body.getAngularVelocity().isZero());
  });
}

}  // namespace

const Effect damping{"damping",
                     "bodies lose speed as they move",
                     "applyDamping of each body in each substep",
                     calls_for_damping,
                     {.prepare = prepare_damping, .configure_body = configure_damping},
                     {"bodies", count_damped}};

}  // namespace boxstream::effects
