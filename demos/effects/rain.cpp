// SPDX-License-Identifier: MIT
#include "effects/effects.hpp"
#include "effects/find.hpp"
#include "effects/stage.hpp"
#include "engine/convert.hpp"
#include "scene/random.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_kind<RainGenerator>(subject.scene.generators, "/generators", "bodies come and go");
}

/// One generator's bodies, and whose turn is next.
struct Cloud {
  RainGenerator generator;
  std::size_t first, count, next = 0;
  Random random;
};

void drop(Stage& stage, Cloud& cloud) {
  const std::size_t index = cloud.first + cloud.next;
  cloud.next = (cloud.next + 1) % cloud.count;
  stage.leave(index);
  const RainGenerator& g = cloud.generator;
  Vec3 place = g.origin;
  for (std::size_t d = 0; d < 3; ++d) place[d] += cloud.random.range(-g.size[d] / 2, g.size[d] / 2);
  const Quat rotation = g.turned ? cloud.random.rotation() : Quat{0, 0, 0, 1};
  btRigidBody& body = *stage.bodies[index];
  // As if it had just been made: forces and contacts of its former life are gone with the pairs.
  body.clearForces();
  body.setWorldTransform(transform(place, rotation));
  body.setInterpolationWorldTransform(body.getWorldTransform());
  body.setLinearVelocity(vector(g.velocity));
  body.setAngularVelocity(btVector3(0, 0, 0));
  body.updateInertiaTensor();
  stage.enter(index);
  body.activate(true);
}

void start(Stage& stage) {
  const std::vector<Generator>& generators = stage.scene.generators;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    const auto* const rain_of = std::get_if<RainGenerator>(&generators[i]);
    if (rain_of == nullptr) continue;
    const std::size_t first = stage.expanded.bodies_of_generator[i];
    Cloud cloud{*rain_of, first, stage.expanded.bodies_of_generator[i + 1] - first, 0,
                Random(stage.scene.world.seed + 0x2545f4914f6cdd1du * (i + 1))};
    stage.before_step(rain, [&stage, cloud](double) mutable {
      if (stage.steps % static_cast<std::uint64_t>(cloud.generator.every) != 0) return;
      for (int k = 0; k < cloud.generator.at_once; ++k) drop(stage, cloud);
    });
  }
}

}  // namespace

const Effect rain{"rain",
                  "bodies are put into the world and taken out while it runs",
                  "removeRigidBody and addRigidBody of some bodies before a step",
                  called_for,
                  nullptr,
                  nullptr,
                  start};

}  // namespace boxstream::effects
