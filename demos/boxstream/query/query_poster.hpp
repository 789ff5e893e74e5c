// SPDX-License-Identifier: MIT
#pragma once

#include "pictures/drawing/poster.hpp"
#include "simulation/query/run.hpp"
#include "simulation/query/scene.hpp"

namespace boxstream::tool {

/// The scene after the last step, what touches across groups in red, and what the queries cost.
picture::Poster query_poster(const query::QueryScene& scene, const query::RunResult& result);

}  // namespace boxstream::tool
