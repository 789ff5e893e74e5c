// SPDX-License-Identifier: MIT
#include <cmath>

#include "effects/effects.hpp"
#include "effects/field_tools.hpp"
#include "effects/find.hpp"
#include "engine/convert.hpp"
#include "scene/random.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> called_for(const Subject& subject) {
  return first_kind<KicksField>(subject.scene.fields, "/fields", "new velocities");
}

void start(Stage& stage) {
  std::vector<std::size_t> dynamic;
  for (std::size_t i = 0; i < stage.bodies.size(); ++i)
    if (is_dynamic(stage.expanded.bodies[i])) dynamic.push_back(i);
  if (dynamic.empty()) return;
  std::uint64_t stream = 0;
  for_each_field<KicksField>(stage, [&](const KicksField& field) {
    const auto count = static_cast<std::size_t>(std::ceil(field.share * static_cast<double>(dynamic.size())));
    Random random(stage.scene.world.seed + 0x517cc1b727220a95u * ++stream);
    stage.before_step(kicks, [&stage, field, dynamic, count, random, next = std::size_t{0}](double) mutable {
      for (std::size_t k = 0; k < count; ++k, next = (next + 1) % dynamic.size()) {
        btRigidBody& body = *stage.bodies[dynamic[next]];
        body.setLinearVelocity(vector(random.in_ball(field.speed)));
        body.activate();
      }
    });
  });
}

}  // namespace

const Effect kicks{"kicks",
                   "bodies get a new velocity in turn",
                   "setLinearVelocity of a share of the bodies before each step",
                   called_for,
                   nullptr,
                   nullptr,
                   start};

}  // namespace boxstream::effects
