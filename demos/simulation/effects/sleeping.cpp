// SPDX-License-Identifier: MIT
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/shape_size.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

// Bullet puts an island to rest when all of it has been slow for this long.
constexpr double rest_time = 2;

std::optional<Call> calls_for_sleeping(const Subject& subject) {
  const Time& time = subject.scene.time;
  if (time.dt * (time.warmup_steps + time.steps) <= rest_time) return std::nullopt;
  return first_body(subject, [](const Body& body) -> std::string {
    return is_dynamic(body) && body.traits.sleep ? "a dynamic body that may sleep" : "";
  });
}

void prepare_sleeping(const Subject&, WorldRecipe& recipe) {
  recipe.deactivate = true;
}

/// Bullet takes 0.8 m/s for slow: of a small body, as much of its size is.
void configure_sleeping(const Subject& subject, const Body& description, btRigidBody& body) {
  if (!is_dynamic(description) || !description.traits.sleep) return;
  body.forceActivationState(ACTIVE_TAG);
  if (const ShapeSize size = size_of(subject.expanded.shapes, description.traits.shape); size.is_small())
    body.setSleepingThresholds(body.getLinearSleepingThreshold() * real(size.largest),
                               body.getAngularSleepingThreshold());
}

/// What a spring or a motor moves at less than Bullet's limits is not at rest.
void start_sleeping(SceneInstance& instance) {
  const auto keep_awake = [&](std::size_t body) {
    if (is_dynamic(instance.expanded.bodies[body])) instance.bodies[body]->forceActivationState(DISABLE_DEACTIVATION);
  };
  for (const Joint& joint : instance.expanded.joints) {
    if (!drives(joint)) continue;
    keep_awake(joint.a);
    if (joint.b) keep_awake(*joint.b);
  }
}

std::uint64_t count_asleep(const SceneInstance& instance) {
  return static_cast<std::uint64_t>(std::count_if(instance.bodies.begin(), instance.bodies.end(), [](const auto& body) {
    return !body->isStaticOrKinematicObject() && body->isInWorld() && !body->isActive();
  }));
}

}  // namespace

const Effect sleeping{"sleeping",
                      "bodies at rest are left alone until something moves them",
                      "updateActivationState; sleeping bodies keep their boxes",
                      calls_for_sleeping,
                      {.prepare = prepare_sleeping, .configure_body = configure_sleeping, .start = start_sleeping},
                      {"sleeping bodies", count_asleep}};

}  // namespace boxstream::effects
