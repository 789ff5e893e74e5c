// SPDX-License-Identifier: MIT
#include "boxstream/shared/command.hpp"

#include <algorithm>

#include "base/nearest_word.hpp"
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
  CommandLine& added = above.add_below(command.name, command.about);
  if (*command.help != '\0') added.footer(command.help);  // else that of the command above
  for (const Command* const part : command.parts) add_command(added, *part, chosen);
  if (!command.parts.empty()) {
    added.require_below();
  } else {
    added.on_parsed([&chosen, action = command.set_up(added)] { chosen = action; });
  }
}

void add_steps(CommandLine& command, std::optional<std::uint64_t>& steps, const char* text) {
  add_number(command, "--steps", steps, text, 1, 10'000'000);
}

void add_scale(CommandLine& command, double& scale, const char* text) {
  add_number(command, "--scale", scale, text, 1e-4, 1e4, "FACTOR");
}

Option add_json(CommandLine& command, std::string& file, const std::string& text) {
  return command.add_option("--json", file, text + "; - is standard output").type("FILE");
}

Option add_budget(CommandLine& command, double& seconds, const char* text) {
  return command.add_option("--budget", seconds, text).type("TIME").as_time(1, 100000);
}

Option add_input(CommandLine& command, const char* name, std::string& file, const char* text) {
  return command.add_option(name, file, text).type("");
}

Option take_words(CommandLine& command, Option option, const std::string& noun, const std::vector<std::string>& words) {
  std::string text = option.text();
  if (const std::size_t place = text.find("{}"); place != std::string::npos) text.replace(place, 2, either(words));
  option.text(text);
  command.complete(option, [words] { return words; });
  return option.check([noun, words](const std::string& given) {
    const bool known = words.empty() || std::find(words.begin(), words.end(), given) != words.end();
    return known ? std::string{} : unknown_word(noun, given, words);
  });
}

Option take_broadphase(CommandLine& command, Option option, std::vector<std::string> more) {
  more.insert(more.end(), scenes::broadphase_names().begin(), scenes::broadphase_names().end());
  return take_words(command, option, "broad-phase", more);
}

}  // namespace boxstream::tool
