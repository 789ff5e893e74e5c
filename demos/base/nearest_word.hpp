// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream {

/// "; did you mean 'NAME'?" with the one of `names` that is the fewest slips of a finger away from `given`, or that
/// begins with it; nothing if all are too far.
std::string did_you_mean(const std::string& given, const std::vector<std::string>& names);

/// "unknown NOUN 'GIVEN'", then the nearest of `names`, or, if none is near, all of them.
std::string unknown_word(const std::string& noun, const std::string& given, const std::vector<std::string>& names);

}  // namespace boxstream
