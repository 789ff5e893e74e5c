// SPDX-License-Identifier: MIT
#include "boxstream/shared/command.hpp"

#include <algorithm>
#include <limits>

#include "base/words.hpp"
#include "formats/scene_model/names.hpp"

namespace boxstream::tool {
namespace {

/// "these, those or others".
std::string either(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i)
    text += (i == 0 ? "" : i + 1 < words.size() ? ", " : " or ") + words[i];
  return text;
}

}  // namespace

void add_command(CommandLine& above, const Command& command, Action& chosen) {
  const auto part_of = std::make_shared<CommandLine>(command.about, command.name);
  above.add_subcommand(part_of);
  CommandLine& added = *part_of;
  added.footer(*command.help != '\0' ? command.help : above.get_footer());
  for (const Command* const part : command.parts) add_command(added, *part, chosen);
  if (!command.parts.empty()) {
    added.require_subcommand(1);
  } else {
    added.callback([&chosen, action = command.set_up(added)] { chosen = action; });
  }
}

void add_steps(CommandLine& command, std::optional<std::uint64_t>& steps, const char* text) {
  add_number(command, "--steps", steps, text, 1, 10'000'000);
}

void add_scale(CommandLine& command, double& scale, const char* text) {
  add_number(command, "--scale", scale, text, 1e-4, 1e4, "FACTOR");
}

CLI::Option* add_max_pairs(CommandLine& command, std::uint64_t& most) {
  return add_number(command, "--max-pairs", most, "Refuse more pairs at once than this; default: 1000000", 1,
                    std::numeric_limits<int>::max());
}

CLI::Option* add_json(CommandLine& command, std::string& file, const std::string& text) {
  return command.add_option("--json", file, text + "; - is standard output")->type_name("FILE");
}

CLI::Option* add_budget(CommandLine& command, double& seconds, const char* text) {
  return take_time(command.add_option("--budget", seconds, text)->type_name("TIME"), 1, 100000);
}

CLI::Option* add_input(CommandLine& command, const char* name, std::string& file, const char* text) {
  return command.add_option(name, file, text)->type_name("");
}

CLI::Option* take_words(CommandLine& command, CLI::Option* option, const std::string& noun,
                        const std::vector<std::string>& words) {
  std::string text = option->get_description();
  if (const std::size_t place = text.find("{}"); place != std::string::npos) text.replace(place, 2, either(words));
  option->description(text);
  command.complete(option, [words] { return words; });
  return option->check([noun, words](const std::string& given) {
    const bool known = words.empty() || std::find(words.begin(), words.end(), given) != words.end();
    return known ? std::string{} : unknown_word(noun, given, words);
  });
}

CLI::Option* take_broadphase(CommandLine& command, CLI::Option* option, std::vector<std::string> more) {
  more.insert(more.end(), scenes::broadphase_names().begin(), scenes::broadphase_names().end());
  return take_words(command, option, "broad-phase", more);
}

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
