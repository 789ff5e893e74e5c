// SPDX-License-Identifier: MIT
#include <cmath>

#include "formats/scene_model/random.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/field_kit.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

/// Rounded up, unless a whole number was missed by rounding alone: 0.07 times 100 is a little more than 7.
std::size_t count_of(double share, std::size_t bodies) {
  return static_cast<std::size_t>(std::ceil(share * static_cast<double>(bodies) * (1 - 1e-12)));
}

void start_impulses(SceneInstance& instance) {
  std::vector<std::size_t> dynamic;
  for (std::size_t i = 0; i < instance.bodies.size(); ++i)
    if (is_dynamic(instance.expanded.bodies[i])) dynamic.push_back(i);
  if (dynamic.empty()) return;
  std::uint64_t stream = 0;
  for_each_field<ImpulsesField>(instance, [&](const ImpulsesField& field) {
    const std::size_t count = count_of(field.share, dynamic.size());
    Random random(instance.scene.world.seed + 0x517cc1b727220a95u * ++stream);
    instance.before_step(impulses, [&instance, field, dynamic, count, random, next = std::size_t{0}](double) mutable {
      for (std::size_t k = 0; k < count; ++k, next = (next + 1) % dynamic.size()) {
        btRigidBody& body = *instance.bodies[dynamic[next]];
        if (body.isStaticOrKinematicObject() || !body.isInWorld()) continue;  // frozen, or away
        instance.acting_on(body);
        body.setLinearVelocity(vector(random.in_ball(field.speed)));
        body.activate();
        ++instance.impulses;
      }
    });
  });
}

std::optional<Call> calls_for_impulses(const Subject& subject) {
  return called_for<ImpulsesField>(subject, "new velocities", [](const ImpulsesField&) { return true; });
}

std::uint64_t count_impulses(const SceneInstance& instance) {
  return instance.impulses;
}

}  // namespace

const Effect impulses{"impulses",
                      "bodies get a new velocity in turn",
                      "setLinearVelocity of a share of the bodies before each step",
                      calls_for_impulses,
                      {.start = start_impulses},
                      {"impulses", count_impulses, Effect::Activity::of_run}};

}  // namespace boxstream::effects
