// SPDX-License-Identifier: MIT
#include "simulation/effects/effects.hpp"
#include "simulation/effects/field_kit.hpp"
#include "simulation/effects/flow.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::effects {
namespace {

using namespace scenes;

std::optional<Call> calls_for_wind(const Subject& subject) {
  return called_for<WindField>(subject, "wind",
                               [](const WindField& field) { return field.density > 0 && field.coefficient > 0; });
}

void start_wind(SceneInstance& instance) {
  for_each_field<WindField>(instance, [&](const WindField& field) {
    const Flow flow(instance, vector(field.velocity), field.density, field.coefficient);
    instance.before_substep(wind, [flow](double dt) { flow.push(dt); });
  });
}

}  // namespace

const Effect wind{"wind",
                  "moving air pushes bodies",
                  "a force and a torque on each dynamic body before each substep, by the area turned to it",
                  calls_for_wind,
                  {.start = start_wind},
                  {"bodies", count_pushed<WindField>}};

}  // namespace boxstream::effects
