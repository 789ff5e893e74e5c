// SPDX-License-Identifier: MIT
#include "simulation/effects/plan.hpp"

#include <algorithm>

#include "base/words.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "simulation/effects/effects.hpp"

namespace boxstream::effects {
namespace {

/// The decision about the effect that place `index` of a list of wishes names.
const Decision& wished(const Plan& plan, const scenes::Scene& scene, const char* list, std::size_t index,
                       const std::string& name) {
  const auto found =
      std::find_if(plan.begin(), plan.end(), [&](const Decision& decision) { return decision.effect->name == name; });
  if (found != plan.end()) return *found;
  std::vector<std::string> known;
  for (const Decision& decision : plan) known.emplace_back(decision.effect->name);
  throw scenes::SceneError(scene.file + ": /effects/" + list + "/" + std::to_string(index) + ": " +
                           unknown_word("effect", name, known));
}

void check_wishes(const Plan& plan, const scenes::Scene& scene) {
  const scenes::EffectWishes& wishes = scene.effects;
  for (std::size_t i = 0; i < wishes.require.size(); ++i)
    if (!wished(plan, scene, "require", i, wishes.require[i]).call)
      throw scenes::SceneError(scene.file + ": /effects/require/" + std::to_string(i) + ": nothing calls for \"" +
                               wishes.require[i] + "\"");
  for (std::size_t i = 0; i < wishes.forbid.size(); ++i)
    if (const Decision& decision = wished(plan, scene, "forbid", i, wishes.forbid[i]); decision.call)
      throw scenes::SceneError(scene.file + ": /effects/forbid/" + std::to_string(i) + ": \"" + wishes.forbid[i] +
                               "\" is called for by " + decision.call->pointer + " (" + decision.call->reason + ")");
}

}  // namespace

Plan plan(const Subject& subject, Extent extent) {
  Plan plan;
  for (const Effect* const effect : all_effects()) {
    Decision decision{effect, effect->called_for(subject), extent == Extent::all};
    decision.on = decision.on || decision.call.has_value();
    plan.push_back(std::move(decision));
  }
  if (extent == Extent::only_called) check_wishes(plan, subject.scene);
  return plan;
}

Plan plan(const scenes::Scene& scene, Extent extent) {
  const scenes::Expanded expanded = scenes::expand(scene);
  return plan(Subject{scene, expanded}, extent);
}

const std::vector<const Effect*>& all_effects() {
  const auto list = [](const auto&... effect) { return std::vector<const Effect*>{&effect...}; };
  static const std::vector<const Effect*> effects = list(BOXSTREAM_EFFECTS);
  return effects;
}

bool is_on(const Plan& plan, const Effect& effect) {
  return std::any_of(plan.begin(), plan.end(),
                     [&](const Decision& decision) { return decision.effect == &effect && decision.on; });
}

}  // namespace boxstream::effects
