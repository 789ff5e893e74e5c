// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "measure/machine.hpp"

namespace boxstream::tool {

using measure::compiler_name;
using measure::cpu_name;

/// "3.24".
std::string bullet_version();

}  // namespace boxstream::tool
