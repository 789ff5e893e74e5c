// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace boxstream::tool {

/// The words that an option or argument takes, in the order in which a user reads them.
using Words = std::function<std::vector<std::string>()>;

/// The options of a command as CLI11 has them, and the words that complete each: --help, the manual and completion in
/// shells are made from it.
class CommandLine : public CLI::App {
 public:
  explicit CommandLine(const std::string& about, const std::string& name, CommandLine* above = nullptr)
      : CLI::App(about, name, above) {
    if (above == nullptr) set_help_flag("-h,--help", "Print this help message and exit");
  }

  /// Adds a command below this one, which lives as long.
  CommandLine& add_below(const std::string& name, const std::string& about);
  /// What users may see, in the order of the help.
  std::vector<const CommandLine*> below() const;
  /// Those with a name that begins with a hyphen, and the others.
  std::vector<const CLI::Option*> options() const;
  std::vector<const CLI::Option*> arguments() const;
  /// "boxstream mesh check", with `separator` in place of the blanks.
  std::string whole_name(const char* separator = " ") const;

  /// Completion offers these words, beside files where the option takes files.
  void complete(const CLI::Option* option, Words words) { words_[option] = std::move(words); }
  /// Empty if the option takes none from a list.
  std::vector<std::string> words_of(const CLI::Option* option) const;

 private:
  std::map<const CLI::Option*, Words> words_;
};

/// "-o", "--output".
std::vector<std::string> names_of(const CLI::Option& option);

/// Options of type FILE, and arguments without a type.
bool takes_files(const CLI::Option& option);

}  // namespace boxstream::tool
