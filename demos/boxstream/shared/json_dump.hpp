// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace boxstream::tool {

/// JSON in ASCII, so that no name in it steers a terminal; bytes that are no UTF-8 are replaced. `indent` below 0: on
/// one line.
inline std::string json_dump(const nlohmann::ordered_json& json, int indent) {
  return json.dump(indent, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace boxstream::tool
