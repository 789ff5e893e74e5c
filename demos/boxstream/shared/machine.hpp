// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "measure/machine.hpp"

namespace boxstream::tool {

using measure::compiler_name;
using measure::cpu_name;

/// "3.24".
std::string bullet_version();

/// "boxstream 1.0, Bullet 3.24": what made a recording.
std::string versions();

}  // namespace boxstream::tool
