// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "boxstream/shared/command_line.hpp"

namespace boxstream::tool {

/// What the help of the tool says behind its commands, in a build that lacks those of `missing`: examples of the others
/// alone.
std::string main_help(const std::vector<std::string>& missing);

/// What is wrong with a word that stands where a command should, where the tool has `commands` and lacks `missing`.
std::string unknown_command(const std::string& word, const std::vector<std::string>& commands,
                            const std::vector<std::string>& missing);

/// Prints its result on standard output and returns the exit code. Throws BadInput, files::BadFile and
/// scenes::SceneError for what the user got wrong, and anything else for what went wrong underneath.
using Action = std::function<int()>;

/// A command of the tool: each is defined beside what it does, and listed in commands.cpp.
struct Command {
  const char* name;
  const char* about;  ///< one line
  const char* help;   ///< what follows the options
  /// Adds the options to the command line; what it returns is run once they are parsed. Null if there are parts.
  Action (*set_up)(CommandLine& command);
  std::vector<const Command*> parts = {};  ///< commands below this one
};

/// In the order of the help.
const std::vector<const Command*>& commands();

/// The names of those that this build of the tool was made without; ./dev build makes all.
const std::vector<std::string>& missing_commands();

/// Adds the command to the command line. When it is parsed and right, `chosen`, which must outlive `above`, becomes
/// what the command does.
void add_command(CommandLine& above, const Command& command, Action& chosen);

// Options that several commands have.
void add_steps(CommandLine& command, std::optional<std::uint64_t>& steps, const char* text);
void add_scale(CommandLine& command, double& scale, const char* text);
/// --max-pairs, beyond which a file is refused; Bullet counts pairs in `int`.
CLI::Option* add_max_pairs(CommandLine& command, std::uint64_t& most);
/// `text` says what is written.
CLI::Option* add_json(CommandLine& command, std::string& file,
                      const std::string& text = "Write everything that was measured");

template <class Value>
CLI::Option* add_file(CommandLine& command, const char* option, Value& value, const char* text) {
  return command.add_option(option, value, text)->type_name("FILE");
}
/// How long the command may look: `seconds` is the default.
CLI::Option* add_budget(CommandLine& command, double& seconds, const char* text);
/// The argument `name`, a file to read.
CLI::Option* add_input(CommandLine& command, const char* name, std::string& file, const char* text);
template <class Value>
CLI::Option* add_name(CommandLine& command, const char* option, Value& value, const char* text) {
  return command.add_option(option, value, text)->type_name("NAME");
}
template <class Value, class Number>
CLI::Option* add_number(CommandLine& command, const char* option, Value& value, const char* text, Number least,
                        Number most, const char* type = "N") {
  return command.add_option(option, value, text)->type_name(type)->check(CLI::Range(least, most));
}
/// Takes one of `words` and refuses others: "unknown NOUN ...". "{}" in its text stands for "these, those or others".
/// Of no words it takes any, which a build without their engine refuses later.
CLI::Option* take_words(CommandLine& command, CLI::Option* option, const std::string& noun,
                        const std::vector<std::string>& words);
/// Takes a broad-phase for Bullet, or one of `more`.
CLI::Option* take_broadphase(CommandLine& command, CLI::Option* option, std::vector<std::string> more = {});

}  // namespace boxstream::tool
