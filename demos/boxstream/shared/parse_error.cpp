// SPDX-License-Identifier: MIT
#include "boxstream/shared/parse_error.hpp"

#include <fmt/format.h>

#include <vector>

#include "base/nearest_word.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/main_help.hpp"

namespace boxstream::tool {
namespace {

std::vector<std::string> commands_of(const CommandLine& command) {
  std::vector<std::string> names;
  for (const CommandLine* const each : command.below()) names.push_back(each->name());
  return names;
}

std::vector<std::string> options_of(const CommandLine& command) {
  std::vector<std::string> names;
  for (const Option& each : command.options())
    for (const std::string& name : each.names()) names.push_back(name);
  return names;
}

/// The word that no command took; empty if all were.
std::string first_unknown(const CommandLine& app) {
  const std::vector<std::string> words = app.left_over();
  // An option that is not known leaves its value behind, too.
  for (const std::string& word : words)
    if (word.size() > 1 && word[0] == '-' && word != "--") return word;
  return words.empty() ? "" : words.front();
}

std::string reason(const CommandLine& here, const std::string& unknown, const std::string& error) {
  if (unknown.empty()) return error;
  if (unknown.size() > 1 && unknown[0] == '-') {
    const std::string name = unknown.substr(0, unknown.find('='));
    return fmt::format("unknown option '{}'{}", name, did_you_mean(name, options_of(here)));
  }
  if (const std::vector<std::string> commands = commands_of(here); !commands.empty())
    return unknown_command(unknown, commands,
                           here.above() == nullptr ? missing_commands() : std::vector<std::string>());
  return fmt::format("{}: one argument too many", unknown);
}

}  // namespace

std::string explain(const CommandLine& app, const std::string& error) {
  const CommandLine& here = app.reached();
  return fmt::format("{} (see {} --help)", reason(here, first_unknown(app), error), here.whole_name());
}

}  // namespace boxstream::tool
