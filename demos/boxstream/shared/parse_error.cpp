// SPDX-License-Identifier: MIT
#include "boxstream/shared/parse_error.hpp"

#include <fmt/format.h>

#include <vector>

#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {
namespace {

/// The command that the words led to, and its name with those above it.
struct Reached {
  const CLI::App* command;
  std::string name;
};

Reached reached(const CLI::App& app) {
  Reached here{&app, app.get_name()};
  for (auto below = app.get_subcommands(); !below.empty(); below = here.command->get_subcommands()) {
    here.command = below.back();
    here.name += " " + here.command->get_name();
  }
  return here;
}

std::vector<std::string> commands_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* const each : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(each->get_name());
  return names;
}

std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* const each : app.get_options()) {
    for (const std::string& name : each->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : each->get_snames()) names.push_back("-" + name);
  }
  return names;
}

/// The word that no command took; empty if all were.
std::string first_unknown(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  // An option that is not known leaves its value behind, too.
  for (const std::string& word : words)
    if (word.size() > 1 && word[0] == '-' && word != "--") return word;
  return words.empty() ? "" : words.front();
}

std::string reason(const Reached& here, const std::string& unknown, const CLI::ParseError& error) {
  if (unknown.empty()) return error.what();
  if (unknown.size() > 1 && unknown[0] == '-') {
    const std::string name = unknown.substr(0, unknown.find('='));
    return fmt::format("unknown option {}{}", name, did_you_mean(name, options_of(*here.command)));
  }
  if (const std::vector<std::string> commands = commands_of(*here.command); !commands.empty())
    return fmt::format("unknown command {}{}", unknown, did_you_mean(unknown, commands));
  return fmt::format("{}: one argument too many", unknown);
}

}  // namespace

std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const Reached here = reached(app);
  return fmt::format("{} (see {} --help)", reason(here, first_unknown(app), error), here.name);
}

}  // namespace boxstream::tool
