// SPDX-License-Identifier: MIT
#include <algorithm>
#include <compare>

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

/// Compares what is inside with what was inside after the step before. In the first step that counts, after a warm-up
/// too, everything inside has just entered.
class SensorMonitor {
 public:
  explicit SensorMonitor(SceneInstance& instance) : instance_(instance), inside_(instance.sensors.size()) {
    for (std::uint32_t i = 0; i < instance.bodies.size(); ++i) {
      const BodyTraits& traits = instance.expanded.bodies[i].traits;
      if (traits.type == BodyType::kinematic && !traits.group && !traits.mask) kinematic_.push_back(i);
    }
  }

  void operator()(double) {
    std::vector<SensorEvent>& events = instance_.sensor_events;
    events.clear();
    for (std::uint32_t sensor = 0; sensor < inside_.size(); ++sensor) {
      std::vector<Guest>& before = inside_[sensor];
      if (instance_.steps == 1) before.clear();
      now_.clear();
      collect(*instance_.sensors[sensor]);
      for_each_missing(before, now_, [&](std::uint32_t object) { events.push_back({sensor, object, false}); });
      for_each_missing(now_, before, [&](std::uint32_t object) { events.push_back({sensor, object, true}); });
      before.swap(now_);
    }
  }

 private:
  /// A body that `respawn` puts elsewhere within the sensor is another guest.
  struct Guest {
    std::uint32_t object;
    int life;
    auto operator<=>(const Guest&) const = default;
  };

  void collect(const btGhostObject& sensor) {
    const auto add = [&](const btCollisionObject& object) {
      now_.push_back({static_cast<std::uint32_t>(object.getUserIndex()), object.getUserIndex2()});
    };
    for (int i = 0; i < sensor.getNumOverlappingObjects(); ++i)
      if (const btCollisionObject& object = *sensor.getOverlappingObject(i); !is_fixed(object)) add(object);
    // To Bullet's filter kinematic bodies are fixed ones, so ghosts do not see them.
    for (const std::uint32_t i : kinematic_) {
      const btBroadphaseProxy* const proxy = instance_.bodies[i]->getBroadphaseHandle();
      const btBroadphaseProxy& own = *sensor.getBroadphaseHandle();
      if (proxy != nullptr && TestAabbAgainstAabb2(proxy->m_aabbMin, proxy->m_aabbMax, own.m_aabbMin, own.m_aabbMax))
        add(*instance_.bodies[i]);
    }
    std::sort(now_.begin(), now_.end());
  }

  /// With a group of its own a fixed body looks to Bullet's filter as others do.
  bool is_fixed(const btCollisionObject& object) const {
    const auto index = static_cast<std::size_t>(object.getUserIndex());
    return index < instance_.bodies.size() && instance_.expanded.bodies[index].traits.type == BodyType::fixed;
  }

  template <class Visit>
  static void for_each_missing(const std::vector<Guest>& from, const std::vector<Guest>& in, Visit visit) {
    for (const Guest& guest : from)
      if (!std::binary_search(in.begin(), in.end(), guest)) visit(guest.object);
  }

  SceneInstance& instance_;
  std::vector<std::uint32_t> kinematic_;
  std::vector<std::vector<Guest>> inside_;  // of each sensor, ascending
  std::vector<Guest> now_;
};

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
  instance.after_step(sensors, SensorMonitor(instance));
}

std::uint64_t count_events(const SceneInstance& instance) {
  return instance.sensor_events.size();
}

}  // namespace

const Effect sensors{"sensors",
                     "boxes tell what is inside, what enters and what leaves",
                     "btGhostPairCallback, a ghost object for each, a comparison after each step",
                     calls_for_sensors,
                     {.prepare = prepare_sensors, .start = start_sensors},
                     {"bodies that came or left", count_events}};

}  // namespace boxstream::effects
