// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace boxstream::tool {

/// The words that an option or argument takes, in the order in which a user reads them.
using Words = std::function<std::vector<std::string>()>;

/// A command with its options, and the words that complete each: --help and completion in shells are made from it.
/// Commands below it are of this class, too.
class CommandLine final : public CLI::App {
 public:
  using CLI::App::App;

  /// Completion offers these words, beside files where the option takes files.
  void complete(const CLI::Option* option, Words words) { words_[option] = std::move(words); }
  /// Empty if the option takes none from a list.
  std::vector<std::string> words_of(const CLI::Option* option) const;
  /// Given twice, the last one counts, so that scripts can put their defaults first.
  void last_counts(std::initializer_list<const char*> options);

  /// What users may see, in the order of the help.
  std::vector<const CommandLine*> below() const;
  /// Those with a name that begins with a hyphen, and the others.
  std::vector<const CLI::Option*> options() const;
  std::vector<const CLI::Option*> arguments() const;

 private:
  std::map<const CLI::Option*, Words> words_;
};

/// "-o", "--output"; none of an argument.
std::vector<std::string> names_of(const CLI::Option& option);

/// The option takes bytes: 65536, 64K, 1.5GB.
CLI::Option* take_size(CLI::Option* option, std::uint64_t least, std::uint64_t most);
/// The option takes seconds: 60, 60s, 1.5min.
CLI::Option* take_time(CLI::Option* option, double least, double most);

/// Returns what --help and --version print, if they are given. Throws BadInput.
std::string parse(CommandLine& app, int argc, char** argv);

}  // namespace boxstream::tool
