// SPDX-License-Identifier: MIT
#include <filesystem>

#include "base/nearest_word.hpp"
#include "base/output_file.hpp"
#include "boxstream/manual/man_page.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

struct ManOptions {
  std::vector<std::string> command;  // "mesh", "check"; empty: boxstream itself
  std::string directory;             // empty: standard output
};

std::vector<std::string> names_below(const CommandLine& command) {
  std::vector<std::string> names;
  for (const CommandLine* const each : command.below()) names.push_back(each->name());
  return names;
}

const CommandLine& find_below(const CommandLine& above, const std::string& name) {
  for (const CommandLine* const each : above.below())
    if (each->name() == name) return *each;
  throw BadInput(unknown_word("command", name, names_below(above)));
}

void write_pages(const CommandLine& command, const std::filesystem::path& directory) {
  files::write_file((directory / (command.whole_name("-") + ".1")).string(), man_page(command));
  for (const CommandLine* const each : command.below()) write_pages(*each, directory);
}

int run_man(const ManOptions& options, const CommandLine& all) {
  const CommandLine* command = &all;
  for (const std::string& name : options.command) command = &find_below(*command, name);
  if (options.directory.empty()) {
    print(man_page(*command));
  } else {
    write_pages(*command, options.directory);
  }
  return 0;
}

Action set_up_man(CommandLine& command) {
  const auto options = std::make_shared<ManOptions>();
  const CommandLine& all = *command.above();
  command.complete(add_name(command, "COMMAND", options->command, "Of which command; default: boxstream"),
                   [&all] { return names_below(all); });
  command.add_option("--into", options->directory, "Write it, and those of the commands below it, into this directory")
      .type("DIR");
  return [options, &all] { return run_man(*options, all); };
}

}  // namespace

extern const Command man_command{"man", "Print a page of the manual, for man", R"(Examples:
  boxstream man simulate | man -l -
  boxstream man mesh check | man -l -
  boxstream man --into ~/.local/share/man/man1

The pages say what --help says.)",
                                 set_up_man};

}  // namespace boxstream::tool
