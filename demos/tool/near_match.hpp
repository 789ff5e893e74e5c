// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::tool {

/// "; did you mean NAME?" with the one of `names` that is the fewest slips of a finger away from `given`, or nothing if
/// that is too far.
std::string did_you_mean(const std::string& given, const std::vector<std::string>& names);

}  // namespace boxstream::tool
