// SPDX-License-Identifier: MIT
#include "command_line.hpp"

namespace boxstream::tool {

void add_list(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<ListOptions>();
  CLI::App* const command = app.add_subcommand("list", "Name the scenes that come with the tool");
  command->add_flag("--long", options->details, "What each has in it, too, its tags, and where its numbers are from");
  choose(*command, chosen, options, list_command);
}

}  // namespace boxstream::tool
