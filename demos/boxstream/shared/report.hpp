// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

namespace boxstream::tool {

/// The beginning of a report for programs: its format, and "meta", which is `about` and behind it what made the report:
/// boxstream, its SIMD target, the compiler and the processor.
nlohmann::ordered_json report_about(nlohmann::ordered_json about);

}  // namespace boxstream::tool
