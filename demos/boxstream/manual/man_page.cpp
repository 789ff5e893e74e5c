// SPDX-License-Identifier: MIT
#include "boxstream/manual/man_page.hpp"

#include <fmt/format.h>

#include "boxstream/manual/roff.hpp"
#include "boxstream/shared/machine.hpp"

namespace boxstream::tool {
namespace {

/// The text behind the options of --help, in its parts.
struct Help {
  std::string examples, description, exit_code;
};

/// Takes a part of the text out: from `begin` to the next blank line.
std::string take(std::string& text, const std::string& begin) {
  const std::size_t at = text.find(begin);
  if (at == std::string::npos) return {};
  const std::size_t end = std::min(text.find("\n\n", at), text.size());
  const std::string part = text.substr(at + begin.size(), end - at - begin.size());
  text.erase(at, end + 2 - at);
  return part;
}

Help parts_of(std::string help) {
  std::string examples = take(help, "Examples:\n"), exit_code = take(help, "Exit code: ");
  return {std::move(examples), std::move(help), std::move(exit_code)};
}

/// "--steps N", or "FILE" of an argument, as roff.
std::string term(const CLI::Option& option) {
  if (!option.nonpositional()) return Roff::italic(option.get_name(true));
  std::string term;
  for (const std::string& name : names_of(option)) term += (term.empty() ? "" : ", ") + Roff::bold(name);
  return option.get_items_expected_max() == 0 ? term : term + " " + Roff::italic(option.get_type_name());
}

std::string text_of(const CLI::Option& option) {
  std::string text = option.get_description();
  if (option.get_required() && option.nonpositional()) text += "; required";
  for (const CLI::Option* const other : option.get_needs()) text += "; with " + other->get_name();
  for (const CLI::Option* const other : option.get_excludes()) text += "; not with " + other->get_name();
  return text;
}

void add_entries(Roff& page, const char* section, const std::vector<const CLI::Option*>& options) {
  if (options.empty()) return;
  page.section(section);
  for (const CLI::Option* const option : options) page.entry(term(*option), text_of(*option));
}

std::string synopsis(const CommandLine& command) {
  std::string line = Roff::bold(command.whole_name());
  if (!command.below().empty()) line += " " + Roff::italic("COMMAND");
  line += " [" + Roff::italic("OPTIONS") + "]";
  for (const CLI::Option* const argument : command.arguments()) {
    const std::string several = argument->get_items_expected_max() > 1 ? "..." : "";
    const std::string name = Roff::italic(argument->get_name(true)) + several;
    line += argument->get_required() ? " " + name : " [" + name + "]";
  }
  return line;
}

std::string reference(const CommandLine& command) {
  return Roff::bold(command.whole_name("-")) + "(1)";
}

void add_commands(Roff& page, const CommandLine& command) {
  if (command.below().empty()) return;
  page.section("COMMANDS");
  for (const CommandLine* const each : command.below()) page.entry(reference(*each), each->get_description());
}

}  // namespace

std::string man_page(const CommandLine& command) {
  const Help help = parts_of(command.get_footer());
  Roff page;
  page.title(command.whole_name("-"), "boxstream " + measure::library_version());
  page.section("NAME");
  page.raw_line(Roff::plain(command.whole_name("-")) + " \\- " + Roff::plain(command.get_description()));
  page.section("SYNOPSIS");
  page.raw_line(synopsis(command));
  page.section("DESCRIPTION");
  page.prose(help.description.empty() ? command.get_description() + "." : help.description);
  add_commands(page, command);
  add_entries(page, "ARGUMENTS", command.arguments());
  add_entries(page, "OPTIONS", command.options());
  for (const auto& [name, text] : {std::pair{"EXIT STATUS", help.exit_code}, std::pair{"EXAMPLES", help.examples}}) {
    if (text.empty()) continue;
    page.section(name);
    page.prose(text);
  }
  if (const auto* const above = static_cast<const CommandLine*>(command.get_parent())) {
    page.section("SEE ALSO");
    page.raw_line(reference(*above));
  }
  return page.page();
}

}  // namespace boxstream::tool
