// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace boxstream::tool {

/// The words that an option or argument takes, in the order in which a user reads them.
using Words = std::function<std::vector<std::string>()>;

/// An option or argument of a command, which must live as long. Copies are the same one.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  auto operator<=>(const Option&) const = default;

  /// What --help calls its values: "FILE".
  Option type(const std::string& name);
  Option text(const std::string& text);
  Option required();
  /// Both ends included.
  Option in_range(int least, int most);
  Option in_range(double least, double most);
  /// Bytes: 65536, 64K, 1.5GB.
  Option as_size(std::uint64_t least, std::uint64_t most);
  /// Seconds: 60, 60s, 1.5min.
  Option as_time(double least, double most);
  Option existing_directory();
  /// `complaint` says what is wrong with a value, or nothing.
  Option check(const std::function<std::string(const std::string&)>& complaint);
  /// One word may give several values.
  Option separated_by(char delimiter);
  /// May be given several times, with one value each.
  Option takes_all();
  Option needs(Option other);
  Option excludes(Option other);

  /// "--output", or "FILE" of an argument.
  std::string name() const;
  /// "-o", "--output"; none of an argument.
  std::vector<std::string> names() const;
  std::string type() const;
  std::string text() const;
  bool takes_value() const;
  bool takes_several() const;
  /// Options of type FILE, and arguments without a type.
  bool takes_files() const;
  bool may_repeat() const;
  /// 0: none.
  char delimiter() const;

 private:
  CLI::Option* option_;
};

/// The options of a command, and the words that complete each: --help and completion in shells are made from it. CLI11
/// is behind it, and seen by its source only: each source that reads those headers takes seconds more.
class CommandLine {
 public:
  explicit CommandLine(const std::string& about, const std::string& name, const CommandLine* above = nullptr);

  /// Adds a command below this one, which lives as long.
  CommandLine& add_below(const std::string& name, const std::string& about);
  /// Parsing sets `value`, which must live until then: a bool of flags, otherwise a string, a number (int, uint64_t or
  /// double), an optional one of them, or strings.
  Option add_flag(const std::string& names, bool& value, const std::string& text);
  template <class Value>
  Option add_option(const std::string& names, Value& value, const std::string& text = "");
  /// --version prints `text`.
  void add_version(const std::string& text);
  /// Given twice, the last one counts, so that scripts can put their defaults first.
  void last_counts(std::initializer_list<const char*> options);
  /// Completion offers these words, beside files where the option takes files.
  void complete(Option option, Words words) { words_[option] = std::move(words); }
  /// What follows the options in --help; by default that of the command above.
  void footer(const std::string& text);
  /// One of the commands below must be given.
  void require_below();
  /// Is called when the command has been parsed.
  void on_parsed(const std::function<void()>& call);
  /// Not for users.
  void hide();

  /// Returns what --help and --version print, if they are given. Throws BadInput.
  std::string parse(int argc, char** argv);
  /// The command that the parsed words led to.
  const CommandLine& reached() const;
  /// The words that no command took.
  std::vector<std::string> left_over() const;

  std::string name() const;
  std::string about() const;
  /// Null of the first.
  const CommandLine* above() const { return above_; }
  /// What users may see, in the order of the help.
  std::vector<const CommandLine*> below() const;
  /// Those with a name that begins with a hyphen, and the others.
  std::vector<Option> options() const;
  std::vector<Option> arguments() const;
  /// By one of its names.
  Option option(const std::string& name) const;
  /// "boxstream mesh check".
  std::string whole_name() const;
  /// Empty if the option takes none from a list.
  std::vector<std::string> words_of(Option option) const;

 private:
  std::shared_ptr<CLI::App> app_;
  const CommandLine* above_;
  std::vector<std::unique_ptr<CommandLine>> below_;
  std::map<Option, Words> words_;
};

}  // namespace boxstream::tool
