// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "boxstream/accuracy/accuracy_result.hpp"

namespace boxstream::tool {

std::string accuracy_json(const AccuracyResult& result);

/// Work against precision, of one measure: its bound, the band within which the reference cannot tell errors apart,
/// and of each line its name, its order of convergence, and what the bound costs on it.
nlohmann::ordered_json precision_json(const AccuracyResult& result, std::size_t measure);

}  // namespace boxstream::tool
