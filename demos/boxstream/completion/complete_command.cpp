// SPDX-License-Identifier: MIT
#include "boxstream/completion/candidates.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

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
  command.hide();
  command.add_option("WORD", *words);
  const CommandLine& all = *command.above();
  return [words, &all] {
    print_raw(text_of(candidates(all, *words)));
    return 0;
  };
}

}  // namespace

extern const Command complete_command{"complete", "Print what may stand in the place of the last word", "",
                                      set_up_complete};

}  // namespace boxstream::tool
