// SPDX-License-Identifier: MIT
#pragma once

#include "boxstream/simulate/simulate.hpp"
#include "formats/scene_model/scene.hpp"
#include "pictures/drawing/poster.hpp"

namespace boxstream::tool {

/// The result as a page: each world as it is now under the same camera, the main numbers, and times and
/// pairs over the steps.
picture::Poster result_poster(const scenes::Scene& scene, const RunResult& result);

}  // namespace boxstream::tool
