// SPDX-License-Identifier: MIT
#include "boxstream/shared/command_line.hpp"
#include "boxstream/shared/bad_input.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/words.hpp"
#include "boxstream/shared/command.hpp"

namespace boxstream::tool {
namespace {

std::vector<std::string> commands_of(const CommandLine& command) {
  std::vector<std::string> names;
  for (const CommandLine* const each : command.below()) names.push_back(each->get_name());
  return names;
}

std::vector<std::string> options_of(const CommandLine& command) {
  std::vector<std::string> names;
  for (const CLI::Option* const each : command.options())
    for (const std::string& name : names_of(*each)) names.push_back(name);
  return names;
}

/// The word that no command took; empty if all were.
std::string first_unknown(const CommandLine& app) {
  const std::vector<std::string> words = app.remaining(true);
  // An option that is not known leaves its value behind, too.
  for (const std::string& word : words)
    if (word.size() > 1 && word[0] == '-' && word != "--") return word;
  return words.empty() ? "" : words.front();
}

std::string reason(const CommandLine& here, const std::string& unknown, const std::string& error) {
  if (unknown.empty()) return error;
  if (unknown.size() > 1 && unknown[0] == '-') {
    const std::string name = unknown.substr(0, unknown.find('='));
    const std::string hint = did_you_mean(name, options_of(here));
    if (hint.empty() && here.get_name() == "try")
      return fmt::format("unknown option '{}'; the program and its options stand behind --", name);
    return fmt::format("unknown option '{}'{}", name, hint);
  }
  if (const std::vector<std::string> commands = commands_of(here); !commands.empty())
    return unknown_command(unknown, commands,
                           here.get_parent() == nullptr ? missing_commands() : std::vector<std::string>());
  return fmt::format("{}: one argument too many", unknown);
}

/// The command that the parsed words led to.
const CommandLine& reached(const CommandLine& app) {
  const std::vector<CLI::App*> parsed = app.get_subcommands();
  return parsed.empty() ? app : reached(static_cast<const CommandLine&>(*parsed.back()));
}

/// "boxstream mesh check".
std::string whole_name(const CLI::App& command) {
  const CLI::App* const above = command.get_parent();
  return above == nullptr ? command.get_name() : whole_name(*above) + " " + command.get_name();
}

/// One line about what is wrong with the command line: names the word that is not known and the nearest that is, or
/// else gives the `error` of parsing, and the help that says more.
std::string explain(const CommandLine& app, const std::string& error) {
  const CommandLine& here = reached(app);
  return fmt::format("{} (see {} --help)", reason(here, first_unknown(app), error), whole_name(here));
}

std::vector<const CLI::Option*> options_of(const CLI::App& app, bool are_named) {
  return app.get_options([&](const CLI::Option* one) { return one->nonpositional() == are_named; });
}

}  // namespace

std::vector<std::string> CommandLine::words_of(const CLI::Option* option) const {
  const auto found = words_.find(option);
  return found == words_.end() ? std::vector<std::string>{} : found->second();
}

void CommandLine::last_counts(std::initializer_list<const char*> options) {
  for (const char* const name : options) get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

std::vector<const CommandLine*> CommandLine::below() const {
  std::vector<const CommandLine*> visible;
  for (const CLI::App* const each : get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); }))
    visible.push_back(static_cast<const CommandLine*>(each));
  return visible;
}

std::vector<const CLI::Option*> CommandLine::options() const {
  return options_of(*this, true);
}

std::vector<const CLI::Option*> CommandLine::arguments() const {
  return options_of(*this, false);
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

CLI::Option* take_size(CLI::Option* option, std::uint64_t least, std::uint64_t most) {
  return option->transform(CLI::AsSizeValue(false).description(""))->check(CLI::Range(least, most).description(""));
}

CLI::Option* take_time(CLI::Option* option, double least, double most) {
  return option->transform(CLI::Validator(
      [least, most](std::string& given) {
        const std::size_t digits = std::min(given.find_first_not_of("0123456789."), given.size());
        double number = 0;
        const auto [end, error] = std::from_chars(given.data(), given.data() + digits, number);
        const std::string_view after(std::string_view(given).substr(digits));
        const bool has_number = error == std::errc() && end == given.data() + digits;
        if (!has_number || (!after.empty() && after != "s" && after != "min"))
          return "no time: " + given + " (60, 60s or 1.5min)";
        const double seconds = after == "min" ? 60 * number : number;
        if (!(seconds >= least && seconds <= most))
          return fmt::format("{} is not between {:g} and {:g} seconds", given, least, most);
        given = fmt::format("{}", seconds);
        return std::string();
      },
      ""));
}

std::string parse(CommandLine& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return {};
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success)) throw BadInput(explain(app, error.what()));
    std::ostringstream text;
    app.exit(error, text);
    return text.str();
  }
}

}  // namespace boxstream::tool
