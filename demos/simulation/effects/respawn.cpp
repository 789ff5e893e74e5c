// SPDX-License-Identifier: MIT
#include "formats/scene_model/random.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"
#include "simulation/effects/scene_instance.hpp"
#include "simulation/engine/convert.hpp"
#include "simulation/engine/mass.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_respawn(const Subject& subject) {
  return first_kind<RespawnGenerator>(subject.scene.generators, "/generators", "bodies come and go");
}

/// One generator's bodies, and whose turn is next.
struct Cloud {
  RespawnGenerator generator;
  std::size_t first, count, next = 0;
  Random random;
};

void drop(SceneInstance& instance, Cloud& cloud) {
  const std::size_t index = cloud.first + cloud.next;
  cloud.next = (cloud.next + 1) % cloud.count;
  instance.acting_on(*instance.bodies[index]);
  instance.leave(index);
  const RespawnGenerator& g = cloud.generator;
  Vec3 place = g.origin;
  for (std::size_t d = 0; d < 3; ++d) place[d] += cloud.random.range(-g.size[d] / 2, g.size[d] / 2);
  const Quat rotation = g.turned ? cloud.random.rotation() : Quat{0, 0, 0, 1};
  btRigidBody& body = *instance.bodies[index];
  // As if it had just been made: forces and contacts of its former life are gone with the pairs; nor is it frozen.
  if (body.isStaticObject()) {
    const Body& description = instance.expanded.bodies[index];
    const Mass mass = mass_of(description, instance.shapes.solid(description.traits.shape));
    body.setMassProps(real(mass.mass), vector(mass.moments));
  }
  body.clearForces();
  instance.put(index, transform(place, rotation));
  body.setInterpolationWorldTransform(body.getWorldTransform());
  body.setLinearVelocity(vector(g.velocity));
  body.setAngularVelocity(btVector3(0, 0, 0));
  body.updateInertiaTensor();
  instance.enter(index);
  ++instance.respawned;
  body.setUserIndex2(static_cast<int>(instance.respawned));  // for those that ask whether it is still the same one
  body.activate(true);
}

void start_respawn(SceneInstance& instance) {
  const std::vector<Generator>& generators = instance.scene.generators;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    const auto* const respawn_of = std::get_if<RespawnGenerator>(&generators[i]);
    if (respawn_of == nullptr) continue;
    const std::size_t first = instance.expanded.bodies_of_generator[i];
    Cloud cloud{*respawn_of, first, instance.expanded.bodies_of_generator[i + 1] - first, 0,
                Random(instance.scene.world.seed + 0x2545f4914f6cdd1du * (i + 1))};
    instance.before_step(respawn, [&instance, cloud](double) mutable {
      if (instance.steps % static_cast<std::uint64_t>(cloud.generator.every) != 0) return;
      for (int k = 0; k < cloud.generator.at_once; ++k) drop(instance, cloud);
    });
  }
}

std::uint64_t count_respawned(const SceneInstance& instance) {
  return instance.respawned;
}

}  // namespace

const Effect respawn{"respawn",
                     "bodies are put into the world and taken out while it runs",
                     "removeRigidBody and addRigidBody of some bodies before a step",
                     calls_for_respawn,
                     {.start = start_respawn},
                     {"bodies", count_respawned, Effect::Activity::of_run}};

}  // namespace boxstream::effects
