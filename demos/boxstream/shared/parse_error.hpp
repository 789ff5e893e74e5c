// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/shared/command_line.hpp"

namespace boxstream::tool {

/// One line about what is wrong with the command line: names the word that is not known and the nearest that is, and
/// the help that says more.
std::string explain(const CommandLine& app, const CLI::ParseError& error);

}  // namespace boxstream::tool
