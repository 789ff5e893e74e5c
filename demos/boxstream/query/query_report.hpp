// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "simulation/query/run.hpp"
#include "simulation/query/scene.hpp"

namespace boxstream::tool {

/// The result for reading: a table for each manager, ending in a newline.
std::string query_table(const query::QueryScene& scene, const query::RunResult& result);

/// The result for programs: one JSON document, ending in a newline. Its fields: demos/boxstream/README.md.
std::string query_json(const query::QueryScene& scene, const query::RunResult& result);

}  // namespace boxstream::tool
