// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>

#include <string>

#include "measure/machine.hpp"

namespace boxstream::tool {

/// JSON in ASCII, so that no name in it steers a terminal; bytes that are no UTF-8 are replaced. `indent` below 0: on
/// one line.
inline std::string json_dump(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

using measure::compiler_name;
using measure::cpu_name;

/// "3.24".
std::string bullet_version();

/// "boxstream 1.0, Bullet 3.24": what made a recording.
std::string versions();

/// The beginning of a report for programs: its format, and "meta", which is `about` and behind it what made the report:
/// boxstream, its SIMD target, the compiler and the processor.
nlohmann::ordered_json report_about(nlohmann::ordered_json about);

}  // namespace boxstream::tool
