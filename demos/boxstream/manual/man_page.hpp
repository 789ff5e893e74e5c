// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/shared/command_line.hpp"

namespace boxstream::tool {

/// What --help says, as a page for man(1).
std::string man_page(const CommandLine& command);

}  // namespace boxstream::tool
