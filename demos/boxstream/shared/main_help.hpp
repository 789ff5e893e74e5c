// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace boxstream::tool {

/// What the help of the tool says behind its commands, in a build that lacks those of `missing`: examples of the others
/// alone.
std::string main_help(const std::vector<std::string>& missing);

/// What is wrong with a word that stands where a command should, where the tool has `commands` and lacks `missing`.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands,
                            const std::vector<std::string>& missing);

}  // namespace boxstream::tool
