// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>

#include "base/nearest_word.hpp"
#include "base/output_file.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/command_line.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"

namespace boxstream::tool {
namespace {

/// Text for a manual page, in roff with the macros of man(7). Text is escaped, so that no word acts as a macro.
class Roff {
 public:
  void title(const std::string& page, const std::string& source);
  void section(const std::string& name);
  /// An entry of a list: `term` is roff, see plain(), bold() and italic(); the text is what follows.
  void entry(const std::string& term, const std::string& text);
  /// Paragraphs with blank lines between them; lines that begin with blanks stay as they are.
  void prose(const std::string& text);
  void raw_line(const std::string& roff) { page_ += roff + "\n"; }

  static std::string plain(const std::string& word);
  static std::string bold(const std::string& word);
  static std::string italic(const std::string& word);

  const std::string& page() const { return page_; }

 private:
  void line(const std::string& text);

  std::string page_;
};

/// Typewriter signs, which roff would set as typographic ones, and its own backslash.
std::string escaped(std::string_view text) {
  std::string roff;
  for (const char c : text) switch (c) {
      case '\\':
        roff += "\\(rs";
        break;
      case '-':
        roff += "\\-";
        break;
      case '\'':
        roff += "\\(aq";
        break;
      case '`':
        roff += "\\(ga";
        break;
      case '^':
        roff += "\\(ha";
        break;
      case '~':
        roff += "\\(ti";
        break;
      case '"':
        roff += "\\(dq";
        break;
      default:
        roff += c;
    }
  return roff;
}

std::string Roff::plain(const std::string& word) {
  return escaped(word);
}

std::string Roff::bold(const std::string& word) {
  return "\\fB" + escaped(word) + "\\fR";
}

std::string Roff::italic(const std::string& word) {
  return "\\fI" + escaped(word) + "\\fR";
}

void Roff::title(const std::string& page, const std::string& source) {
  raw_line(".TH \"" + escaped(page) + "\" \"1\" \"\" \"" + escaped(source) + "\" \"User Commands\"");
}

void Roff::section(const std::string& name) {
  raw_line(".SH " + name);
}

void Roff::entry(const std::string& term, const std::string& text) {
  raw_line(".TP\n" + term);
  line(text);
}

void Roff::prose(const std::string& text) {
  std::istringstream lines(text);
  bool literal = false, parted = false, begun = false;
  const auto become = [&](bool wanted) {
    if (wanted != literal) raw_line(wanted ? ".RS 2\n.nf" : ".fi\n.RE");
    literal = wanted;
  };
  for (std::string each; std::getline(lines, each);) {
    if (each.empty()) {
      parted = begun;
      continue;
    }
    if (parted) become(false), raw_line(".PP");
    become(each.starts_with("  "));
    line(each.substr(literal ? 2 : 0));
    parted = false, begun = true;
  }
  become(false);
}

void Roff::line(const std::string& text) {
  const bool is_request = text.starts_with(".") || text.starts_with("'");
  raw_line((is_request ? "\\&" : "") + escaped(text));
}

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

/// What --help says, as a page for man(1).
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

struct ManOptions {
  std::vector<std::string> command;  // "mesh", "check"; empty: boxstream itself
  std::string directory;             // empty: standard output
};

std::vector<std::string> names_below(const CommandLine& command) {
  std::vector<std::string> names;
  for (const CommandLine* const each : command.below()) names.push_back(each->name());
  return names;
}

const CommandLine& find_below(const CommandLine& above, const std::string& name) {
  for (const CommandLine* const each : above.below())
    if (each->name() == name) return *each;
  throw BadInput(unknown_word("command", name, names_below(above)));
}

void write_pages(const CommandLine& command, const std::filesystem::path& directory) {
  files::write_file((directory / (command.whole_name("-") + ".1")).string(), man_page(command));
  for (const CommandLine* const each : command.below()) write_pages(*each, directory);
}

int run_man(const ManOptions& options, const CommandLine& all) {
  const CommandLine* command = &all;
  for (const std::string& name : options.command) command = &find_below(*command, name);
  if (options.directory.empty()) {
    print(man_page(*command));
  } else {
    write_pages(*command, options.directory);
  }
  return 0;
}

Action set_up_man(CommandLine& command) {
  const auto options = std::make_shared<ManOptions>();
  const CommandLine& all = *command.above();
  command.complete(add_name(command, "COMMAND", options->command, "Of which command; default: boxstream"),
                   [&all] { return names_below(all); });
  command.add_option("--into", options->directory, "Write it, and those of the commands below it, into this directory")
      .type("DIR");
  return [options, &all] { return run_man(*options, all); };
}

}  // namespace

extern const Command man_command{"man", "Print a page of the manual, for man", R"(Examples:
  boxstream man simulate | man -l -
  boxstream man mesh check | man -l -
  boxstream man --into ~/.local/share/man/man1

The pages say what --help says.)",
                                 set_up_man};

}  // namespace boxstream::tool
