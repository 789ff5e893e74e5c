// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/shared/command_line.hpp"

namespace boxstream::tool {

/// One line about what is wrong with the command line: names the word that is not known and the nearest that is, or
/// else gives the `error` of parsing, and the help that says more.
std::string explain(const CommandLine& app, const std::string& error);

}  // namespace boxstream::tool
