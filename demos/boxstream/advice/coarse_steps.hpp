// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// A quantity that the scene's settings get wrong by more than 1 %, as closed forms (docs/internals/closed-forms.md) or
/// other engines (docs/internals/witnesses.md) show.
struct CoarseStep {
  std::string what;                   ///< as "a spring whose period is 4 steps: it swings too slowly"
  std::string advice;                 ///< a sentence: what gets it right
  std::string known;                  ///< a case of the table
  std::string page = "closed-forms";  ///< the table's: this or witnesses
};

/// Empty for most scenes. Throws SceneError for a shape that cannot be built.
std::vector<CoarseStep> coarse_steps(const scenes::Scene& scene);

}  // namespace boxstream::tool
