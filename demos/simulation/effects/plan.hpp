// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "simulation/effects/effect.hpp"

namespace boxstream::effects {

struct Decision {
  const Effect* effect;
  std::optional<Call> call;  ///< none: nothing calls for it
  bool on = false;
};

/// All effects, in the order in which they are built, each with what was decided.
using Plan = std::vector<Decision>;

enum class Extent {
  only_called,  ///< what the scene calls for
  all           ///< everything, for comparison: also what nothing calls for is built and switched on
};

/// A pure function of the scene: adding an element to it never removes an effect, unless the element keeps two bodies
/// from touching, as joints do, or what holds multibodies is something else that they cannot be with.
///
/// With `only_called`, throws SceneError if the scene's `effects` block requires what it does not call for, or forbids
/// what it does, or names an effect that does not exist.
Plan plan(const Subject& subject, Extent extent = Extent::only_called);

/// The same for a scene that is not expanded yet.
Plan plan(const scenes::Scene& scene, Extent extent = Extent::only_called);

bool is_on(const Plan& plan, const Effect& effect);

/// Every effect there is, in order.
const std::vector<const Effect*>& all_effects();

}  // namespace boxstream::effects
