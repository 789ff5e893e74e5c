// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::scenes {

/// As scenes write them, in the order of the enumeration FrictionDirections.
inline const std::vector<std::string>& friction_directions_names() {
  static const std::vector<std::string> names{"one", "two", "two_fixed"};
  return names;
}

}  // namespace boxstream::scenes
