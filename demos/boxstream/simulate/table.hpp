// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/simulate/simulate.hpp"
#include "formats/scene_model/scene.hpp"

namespace boxstream::tool {

/// The result for reading: a small table, ending in a newline.
std::string result_table(const scenes::Scene& scene, const RunResult& result);

/// "12 345 678".
std::string grouped(std::uint64_t number);

}  // namespace boxstream::tool
