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
std::string term(const Option& option) {
  if (option.names().empty()) return Roff::italic(option.name());
  std::string term;
  for (const std::string& name : option.names()) term += (term.empty() ? "" : ", ") + Roff::bold(name);
  return option.takes_value() ? term + " " + Roff::italic(option.type()) : term;
}

std::string text_of(const Option& option) {
  std::string text = option.text();
  if (option.is_required() && !option.names().empty()) text += "; required";
  for (const std::string& other : option.needed()) text += "; with " + other;
  for (const std::string& other : option.excluded()) text += "; not with " + other;
  return text;
}

void add_entries(Roff& page, const char* section, const std::vector<Option>& options) {
  if (options.empty()) return;
  page.section(section);
  for (const Option& option : options) page.entry(term(option), text_of(option));
}

std::string synopsis(const CommandLine& command) {
  std::string line = Roff::bold(command.whole_name());
  if (!command.below().empty()) line += " " + Roff::italic("COMMAND");
  line += " [" + Roff::italic("OPTIONS") + "]";
  for (const Option& argument : command.arguments()) {
    const std::string name = Roff::italic(argument.name()) + (argument.takes_several() ? "..." : "");
    line += argument.is_required() ? " " + name : " [" + name + "]";
  }
  return line;
}

std::string reference(const CommandLine& command) {
  return Roff::bold(command.whole_name("-")) + "(1)";
}

void add_commands(Roff& page, const CommandLine& command) {
  if (command.below().empty()) return;
  page.section("COMMANDS");
  for (const CommandLine* const each : command.below()) page.entry(reference(*each), each->about());
}

}  // namespace

std::string man_page(const CommandLine& command) {
  const Help help = parts_of(command.footer());
  Roff page;
  page.title(command.whole_name("-"), "boxstream " + measure::library_version());
  page.section("NAME");
  page.raw_line(Roff::plain(command.whole_name("-")) + " \\- " + Roff::plain(command.about()));
  page.section("SYNOPSIS");
  page.raw_line(synopsis(command));
  page.section("DESCRIPTION");
  page.prose(help.description.empty() ? command.about() + "." : help.description);
  add_commands(page, command);
  add_entries(page, "ARGUMENTS", command.arguments());
  add_entries(page, "OPTIONS", command.options());
  for (const auto& [name, text] : {std::pair{"EXIT STATUS", help.exit_code}, std::pair{"EXAMPLES", help.examples}}) {
    if (text.empty()) continue;
    page.section(name);
    page.prose(text);
  }
  if (const CommandLine* const above = command.above()) {
    page.section("SEE ALSO");
    page.raw_line(reference(*above));
  }
  return page.page();
}

}  // namespace boxstream::tool
