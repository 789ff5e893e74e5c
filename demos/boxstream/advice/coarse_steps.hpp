// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene_model/scene.hpp"
#include "simulation/effects/effect.hpp"

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

/// Whether a body is so far from the origin that the spacing of floating-point numbers there is coarse against its
/// thickness, or against its motion in a step. Throws SceneError for a shape that cannot be built.
std::optional<CoarseStep> coarse_places(const effects::Subject& subject);

/// The body that flies deepest into a fixed box, of what flies freely until it hits something, if that is more than
/// half of the thinner of the two: step for step as the engine moves it. Nothing where fields push bodies about.
std::optional<CoarseStep> deep_landing(const effects::Subject& subject);

}  // namespace boxstream::tool
