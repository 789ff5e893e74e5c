// SPDX-License-Identifier: MIT
#pragma once

#include "picture/poster.hpp"
#include "query/run.hpp"
#include "query/scene.hpp"

namespace boxstream::tool {

/// The scene after the last step, what touches across groups in red, and what the queries cost.
picture::Poster query_poster(const query::QueryScene& scene, const query::RunResult& result);

}  // namespace boxstream::tool
