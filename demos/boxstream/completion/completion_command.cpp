// SPDX-License-Identifier: MIT
#include <algorithm>

#include "boxstream/completion/shells.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

int print_script(const std::string& shell) {
  const auto found =
      std::find_if(shells().begin(), shells().end(), [&](const Shell& each) { return each.name == shell; });
  print_raw(found->script);
  return 0;
}

Action set_up_completion(CommandLine& command) {
  const auto shell = std::make_shared<std::string>();
  std::vector<std::string> names;
  for (const Shell& each : shells()) names.push_back(each.name);
  take_words(command, add_name(command, "SHELL", *shell, "{}"), "shell", names)->required();
  return [shell] { return print_script(*shell); };
}

}  // namespace

extern const Command completion_command{"completion", "Print what makes a shell complete the words of boxstream",
                                        R"(Examples:
  source <(boxstream completion bash)
  source <(boxstream completion zsh)
  boxstream completion fish | source

Commands, options, their values, names of scenes and files. What is installed has it where the shells look for it.)",
                                        set_up_completion};

}  // namespace boxstream::tool
