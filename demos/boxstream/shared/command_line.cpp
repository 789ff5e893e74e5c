// SPDX-License-Identifier: MIT
#include "boxstream/shared/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/words.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"

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
    const std::string hint = did_you_mean(name, options_of(here));
    if (hint.empty() && here.name() == "try")
      return fmt::format("unknown option '{}'; the program and its options stand behind --", name);
    return fmt::format("unknown option '{}'{}", name, hint);
  }
  if (const std::vector<std::string> commands = commands_of(here); !commands.empty())
    return unknown_command(unknown, commands,
                           here.above() == nullptr ? missing_commands() : std::vector<std::string>());
  return fmt::format("{}: one argument too many", unknown);
}

/// One line about what is wrong with the command line: names the word that is not known and the nearest that is, or
/// else gives the `error` of parsing, and the help that says more.
std::string explain(const CommandLine& app, const std::string& error) {
  const CommandLine& here = app.reached();
  return fmt::format("{} (see {} --help)", reason(here, first_unknown(app), error), here.whole_name());
}

std::vector<Option> options_of(CLI::App& app, bool are_named) {
  std::vector<Option> options;
  for (CLI::Option* const each :
       app.get_options([&](const CLI::Option* one) { return one->nonpositional() == are_named; }))
    options.emplace_back(each);
  return options;
}

}  // namespace

Option Option::type(const std::string& name) {
  return Option(option_->type_name(name));
}

Option Option::text(const std::string& text) {
  return Option(option_->description(text));
}

Option Option::required() {
  return Option(option_->required());
}

Option Option::in_range(int least, int most) {
  return Option(option_->check(CLI::Range(least, most)));
}

Option Option::in_range(double least, double most) {
  return Option(option_->check(CLI::Range(least, most)));
}

Option Option::as_size(std::uint64_t least, std::uint64_t most) {
  option_->transform(CLI::AsSizeValue(false).description(""));
  return Option(option_->check(CLI::Range(least, most).description("")));
}

Option Option::as_time(double least, double most) {
  return Option(option_->transform(CLI::Validator(
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
      "")));
}

Option Option::existing_directory() {
  return Option(option_->check(CLI::ExistingDirectory));
}

Option Option::check(const std::function<std::string(const std::string&)>& complaint) {
  return Option(option_->check(complaint));
}

Option Option::separated_by(char delimiter) {
  return Option(option_->delimiter(delimiter));
}

Option Option::takes_all() {
  return Option(option_->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}

Option Option::needs(Option other) {
  return Option(option_->needs(other.option_));
}

Option Option::excludes(Option other) {
  return Option(option_->excludes(other.option_));
}

std::string Option::name() const {
  return option_->get_name();
}

std::vector<std::string> Option::names() const {
  std::vector<std::string> names;
  for (const std::string& name : option_->get_snames()) names.push_back("-" + name);
  for (const std::string& name : option_->get_lnames()) names.push_back("--" + name);
  return names;
}

std::string Option::type() const {
  return option_->get_type_name();
}

std::string Option::text() const {
  return option_->get_description();
}

bool Option::takes_value() const {
  return option_->get_items_expected_max() > 0;
}

bool Option::takes_several() const {
  return option_->get_items_expected_max() > 1;
}

bool Option::takes_files() const {
  return option_->get_positional() ? type().empty() : type() == "FILE";
}

bool Option::may_repeat() const {
  return option_->get_allow_extra_args();
}

char Option::delimiter() const {
  return option_->get_delimiter();
}

CommandLine::CommandLine(const std::string& about, const std::string& name, const CommandLine* above)
    : app_(above == nullptr ? std::make_shared<CLI::App>(about, name)
                            : above->app_->get_subcommand_ptr(above->app_->add_subcommand(name, about))),
      above_(above) {}

CommandLine& CommandLine::add_below(const std::string& name, const std::string& about) {
  return *below_.emplace_back(std::make_unique<CommandLine>(about, name, this));
}

Option CommandLine::add_flag(const std::string& names, bool& value, const std::string& text) {
  return Option(app_->add_flag(names, value, text));
}

template <class Value>
Option CommandLine::add_option(const std::string& names, Value& value, const std::string& text) {
  return Option(app_->add_option(names, value, text));
}
template Option CommandLine::add_option(const std::string&, std::string&, const std::string&);
template Option CommandLine::add_option(const std::string&, int&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option CommandLine::add_option(const std::string&, double&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<std::string>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<int>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<std::uint64_t>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option CommandLine::add_option(const std::string&, std::vector<std::string>&, const std::string&);

void CommandLine::add_version(const std::string& text) {
  app_->set_version_flag("--version", text, "Print versions and exit");
}

void CommandLine::last_counts(std::initializer_list<const char*> options) {
  for (const char* const name : options) app_->get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

void CommandLine::footer(const std::string& text) {
  app_->footer(text);
}

void CommandLine::require_below() {
  app_->require_subcommand(1);
}

void CommandLine::on_parsed(const std::function<void()>& call) {
  app_->callback(call);
}

void CommandLine::hide() {
  app_->group("");
}

std::string CommandLine::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
    return {};
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() != static_cast<int>(CLI::ExitCodes::Success))
      throw BadInput(explain(*this, error.what()));
    std::ostringstream text;
    app_->exit(error, text);
    return text.str();
  }
}

const CommandLine& CommandLine::reached() const {
  const std::vector<CLI::App*> parsed = app_->get_subcommands();
  if (parsed.empty()) return *this;
  return (*std::find_if(below_.begin(), below_.end(),
                        [&](const auto& each) { return each->app_.get() == parsed.back(); }))
      ->reached();
}

std::vector<std::string> CommandLine::left_over() const {
  return app_->remaining(true);
}

std::string CommandLine::name() const {
  return app_->get_name();
}

std::string CommandLine::about() const {
  return app_->get_description();
}

std::vector<const CommandLine*> CommandLine::below() const {
  std::vector<const CommandLine*> visible;
  for (const auto& each : below_)
    if (!each->app_->get_group().empty()) visible.push_back(each.get());
  return visible;
}

std::vector<Option> CommandLine::options() const {
  return options_of(*app_, true);
}

std::vector<Option> CommandLine::arguments() const {
  return options_of(*app_, false);
}

Option CommandLine::option(const std::string& name) const {
  return Option(app_->get_option(name));
}

std::string CommandLine::whole_name() const {
  return above_ == nullptr ? name() : above_->whole_name() + " " + name();
}

std::vector<std::string> CommandLine::words_of(Option option) const {
  const auto found = words_.find(option);
  return found == words_.end() ? std::vector<std::string>{} : found->second();
}

}  // namespace boxstream::tool
