// SPDX-License-Identifier: MIT
#include "boxstream/shared/main_help.hpp"

#include <algorithm>

#include "base/nearest_word.hpp"

namespace boxstream::tool {
namespace {

bool has(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

std::string main_help(const std::vector<std::string>& missing) {
  std::string text = "Examples:\n";
  for (const auto& [command, arguments] : {std::pair{"list", ""},
                                           {"simulate", " pile --compare dbvt --picture pile.png"},
                                           {"explain", " pile"},
                                           {"accuracy", " pile --knob substeps=1,2,4,8 --metric penetration"},
                                           {"simulate", " pile --log pile.bsrec"},
                                           {"replay", " pile.bsrec --broadphase dbvt"},
                                           {"query", " query_bins --compare tree"},
                                           {"pairs", " boxes.txt"}})
    if (!has(missing, command)) text += std::string("  boxstream ") + command + arguments + "\n";
  text += "\n\"boxstream COMMAND --help\" says more. Colours are for terminals, and none where NO_COLOR is set.\n";
  if (!missing.empty()) text += "This build is a part of the tool: ./dev build makes all of it.\n";
  return text +
         "\nExit code: 0; 1 if pairs or answers differ or the run fails; 2 for bad input, with one line on standard "
         "error.";
}

std::string unknown_command(const std::string& word, const std::vector<std::string>& commands,
                            const std::vector<std::string>& missing) {
  if (has(missing, word)) return "this build has no command '" + word + "': ./dev build makes it";
  std::vector<std::string> all = commands;
  all.insert(all.end(), missing.begin(), missing.end());
  const std::string nearest = did_you_mean(word, all);
  return nearest.empty() ? unknown_word("command", word, commands) : "unknown command '" + word + "'" + nearest;
}

}  // namespace boxstream::tool
