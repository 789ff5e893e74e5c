// SPDX-License-Identifier: MIT
#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "boxstream/shared/command.hpp"
#include "boxstream/shared/command_line.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

/// What may stand in the place of a word that a user has begun.
struct Candidates {
  enum class Beside { nothing, files, directories };
  struct Word {
    std::string text;
    std::string about{};  ///< may be empty
  };
  std::vector<Word> words;          ///< a last '=' or '/' says that the word goes on
  Beside beside = Beside::nothing;  ///< what fits, too
};

/// Where in the command line a word stands.
struct Place {
  const CommandLine* command;
  const CLI::Option* waiting = nullptr;  // an option whose value comes next
  std::size_t arguments = 0;             // of the command, already there
  bool only_arguments = false;           // after "--"
  std::set<const CLI::Option*> used = {};
};

bool is_option(const Place& place, const std::string& word) {
  return !place.only_arguments && word.size() > 1 && word[0] == '-';
}

const CLI::Option* find_option(const CommandLine& command, const std::string& name) {
  return command.get_option_no_throw(name);
}

const CommandLine* find_command(const CommandLine& above, const std::string& name) {
  for (const CommandLine* const each : above.below())
    if (each->get_name() == name) return each;
  return nullptr;
}

void pass_option(Place& place, const std::string& word) {
  const std::size_t equals = word.find('=');
  const CLI::Option* const option = find_option(*place.command, word.substr(0, equals));
  if (!option) return;
  place.used.insert(option);
  if (equals == std::string::npos && option->get_items_expected_max() > 0) place.waiting = option;
}

void pass(Place& place, const std::string& word) {
  if (place.waiting) {
    place.waiting = nullptr;
  } else if (!place.only_arguments && word == "--") {
    place.only_arguments = true;
  } else if (is_option(place, word)) {
    pass_option(place, word);
  } else if (const CommandLine* const below = find_command(*place.command, word)) {
    place = Place{below};
  } else {
    ++place.arguments;
  }
}

/// "effects/wind" is offered as "effects/" until that is there.
std::string up_to_next_slash(const std::string& word, std::size_t begun) {
  const std::size_t slash = word.find('/', begun);
  return slash == std::string::npos ? word : word.substr(0, slash + 1);
}

/// Options of type FILE, and arguments without a type.
bool takes_files(const CLI::Option& option) {
  return option.get_type_name() == (option.get_positional() ? "" : "FILE");
}

/// `before` stands in front of the value in the same word: "--json=".
Candidates values(const Place& place, const CLI::Option* option, std::string before, std::string begun) {
  Candidates found;
  if (takes_files(*option)) found.beside = Candidates::Beside::files;
  if (option->get_type_name() == "DIR") found.beside = Candidates::Beside::directories;
  const char delimiter = option->get_delimiter();  // 0: none
  if (const std::size_t comma = begun.rfind(delimiter); delimiter != '\0' && comma < begun.size()) {
    before += begun.substr(0, comma + 1);
    begun.erase(0, comma + 1);
  }
  for (const std::string& word : place.command->words_of(option)) {
    const std::string text = before + up_to_next_slash(word, begun.size());
    if (word.starts_with(begun) && (found.words.empty() || found.words.back().text != text))
      found.words.push_back({text});
  }
  return found;
}

Candidates options(const Place& place, const std::string& begun) {
  Candidates found;
  for (const CLI::Option* const option : place.command->options())
    for (const std::string& name : names_of(*option))
      if (name.starts_with(begun) && (place.used.count(option) == 0 || option->get_allow_extra_args()))
        found.words.push_back({name, option->get_description()});
  return found;
}

Candidates arguments(const Place& place, const std::string& begun) {
  const std::vector<const CLI::Option*> all = place.command->arguments();
  if (all.empty() || (place.arguments >= all.size() && all.back()->get_items_expected_max() <= 1)) return {};
  return values(place, all[std::min(place.arguments, all.size() - 1)], "", begun);
}

Candidates commands(const CommandLine& above, const std::string& begun) {
  Candidates found;
  for (const CommandLine* const each : above.below())
    if (each->get_name().starts_with(begun)) found.words.push_back({each->get_name(), each->get_description()});
  return found;
}

/// `typed`: the words behind the name of the program, up to and with the one that is begun, which may be empty.
Candidates candidates(const CommandLine& all, const std::vector<std::string>& typed) {
  Place place{&all};
  if (typed.empty()) return commands(all, "");
  std::for_each(typed.begin(), typed.end() - 1, [&](const std::string& word) { pass(place, word); });
  const std::string& begun = typed.back();
  if (place.waiting) return values(place, place.waiting, "", begun);
  if (!place.only_arguments && begun.starts_with("-")) {
    const std::size_t equals = begun.find('=');
    if (equals == std::string::npos) return options(place, begun);
    const CLI::Option* const option = find_option(*place.command, begun.substr(0, equals));
    return !option ? Candidates{} : values(place, option, begun.substr(0, equals + 1), begun.substr(equals + 1));
  }
  if (!place.command->below().empty()) return commands(*place.command, begun);
  return arguments(place, begun);
}

using Beside = Candidates::Beside;

/// For the scripts in shells/: what fits beside the words, then a word a line, with a tab before what it is about.
std::string text_of(const Candidates& found) {
  std::string text = found.beside == Beside::files         ? "files\n"
                     : found.beside == Beside::directories ? "directories\n"
                                                           : "nothing\n";
  for (const Candidates::Word& word : found.words) text += word.text + "\t" + word.about + "\n";
  return text;
}

Action set_up_complete(CommandLine& command) {
  const auto words = std::make_shared<std::vector<std::string>>();
  command.group("");  // not for users
  command.add_option("WORD", *words);
  const auto& all = static_cast<const CommandLine&>(*command.get_parent());
  return [words, &all] {
    print_raw(text_of(candidates(all, *words)));
    return 0;
  };
}

}  // namespace

extern const Command complete_command{"complete", "Print what may stand in the place of the last word", "",
                                      set_up_complete};

}  // namespace boxstream::tool
