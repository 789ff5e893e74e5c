// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace boxstream::tool {

/// One line about what is wrong with the command line: names the word that is not known and the nearest that is, and
/// the help that says more.
std::string explain(const CLI::App& app, const CLI::ParseError& error);

}  // namespace boxstream::tool
