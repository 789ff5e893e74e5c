// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace boxstream::tool {

/// Model name of the processor, or "unknown CPU".
std::string cpu_name();
/// Name and version of the compiler of this program.
std::string compiler_name();
/// "0.1.0".
std::string boxstream_version();
/// "3.24".
std::string bullet_version();

}  // namespace boxstream::tool
