// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::tool {

/// The scripts in shells/, compiled in.
struct Shell {
  std::string name;
  const char* script;
};
const std::vector<Shell>& shells();

}  // namespace boxstream::tool
