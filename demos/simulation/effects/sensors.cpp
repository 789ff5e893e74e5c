// SPDX-License-Identifier: MIT
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/world_recipe.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_sensors(const Subject& subject) {
  return first_of(subject.scene.sensors, "/sensors", "a sensor");
}

void prepare_sensors(const Subject&, WorldRecipe& recipe) {
  recipe.ghost_pairs = true;
  recipe.collide = true;
}

/// A sensor goes by boxes. Bullet would look for contacts with it, keep manifolds of them that are never solved, and
/// solve those of others in another order.
void pass_over_sensors(btBroadphasePair& pair, btCollisionDispatcher& dispatcher, const btDispatcherInfo& info) {
  for (const btBroadphaseProxy* const proxy : {pair.m_pProxy0, pair.m_pProxy1})
    if (!static_cast<const btCollisionObject*>(proxy->m_clientObject)->hasContactResponse()) return;
  btCollisionDispatcher::defaultNearCallback(pair, dispatcher, info);
}

void start_sensors(SceneInstance& instance) {
  if (instance.scene.sensors.empty()) return;
  static_cast<btCollisionDispatcher&>(instance.world.dispatcher()).setNearCallback(pass_over_sensors);
  for (const Sensor& description : instance.scene.sensors) {
    instance.sensor_shapes.push_back(std::make_unique<btBoxShape>(vector(description.half_extents)));
    auto ghost = std::make_unique<btGhostObject>();
    ghost->setCollisionShape(instance.sensor_shapes.back().get());
    ghost->setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT | btCollisionObject::CF_NO_CONTACT_RESPONSE);
    ghost->setWorldTransform(transform(description.position, {0, 0, 0, 1}));
    instance.number(*ghost);
    instance.world.world().addCollisionObject(
        ghost.get(), btBroadphaseProxy::SensorTrigger,
        btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::SensorTrigger ^ btBroadphaseProxy::StaticFilter);
    instance.sensors.push_back(std::move(ghost));
  }
}

}  // namespace

const Effect sensors{"sensors",
                     "boxes count what is inside",
                     "btGhostPairCallback, and a ghost object for each",
                     calls_for_sensors,
                     {.prepare = prepare_sensors, .start = start_sensors}};

}  // namespace boxstream::effects
