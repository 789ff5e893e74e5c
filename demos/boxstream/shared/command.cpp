// SPDX-License-Identifier: MIT
#include "boxstream/shared/command.hpp"

namespace boxstream::tool {

void add_command(CLI::App& app, const Command& command, Action& chosen) {
  CLI::App* const added = app.add_subcommand(command.name, command.about);
  if (*command.help != '\0') added->footer(command.help);  // else that of the command above
  for (const Command* const part : command.parts) add_command(*added, *part, chosen);
  if (!command.parts.empty()) {
    added->require_subcommand(1);
  } else {
    added->callback([&chosen, action = command.set_up(*added)] { chosen = action; });
  }
}

void add_steps(CLI::App& command, std::optional<std::uint64_t>& steps, const char* text) {
  add_number(command, "--steps", steps, text, 1, 10'000'000);
}

void add_scale(CLI::App& command, double& scale, const char* text) {
  add_number(command, "--scale", scale, text, 1e-4, 1e4, "FACTOR");
}

CLI::Option* add_json(CLI::App& command, std::string& file, const std::string& text) {
  return command.add_option("--json", file, text + "; - is standard output")->type_name("FILE");
}

void take_all(CLI::Option* option) {
  option->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void last_counts(CLI::App& command, std::initializer_list<const char*> options) {
  for (const char* const name : options)
    command.get_option(name)->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

}  // namespace boxstream::tool
