// SPDX-License-Identifier: MIT
#include "boxstream/shared/run.hpp"

#include <fmt/format.h>

#include <boxstream/detector.hpp>
#include <sstream>

#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/machine.hpp"
#include "boxstream/shared/parse_error.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

std::string version_text() {
  return fmt::format("boxstream {} (Bullet {}, {}, {})", measure::library_version(), bullet_version(), simd_target(),
                     compiler_name());
}

}  // namespace

int run(int argc, char** argv) {
  CommandLine app("Finds the pairs of axis-aligned boxes that touch, in physics scenes and in files.", "boxstream");
  app.set_version_flag("--version", version_text(), "Print versions and exit");
  app.require_subcommand(1);
  app.footer(
      "Examples:\n  boxstream list\n  boxstream simulate pile --compare dbvt --picture pile.png\n"
      "  boxstream explain pile\n"
      "  boxstream accuracy pile --knob substeps=1,2,4,8 --metric penetration\n"
      "  boxstream simulate pile --log pile.bsrec\n  boxstream replay pile.bsrec --broadphase dbvt\n"
      "  boxstream query query_bins --compare tree\n  boxstream pairs boxes.txt\n\n\"boxstream COMMAND --help\" says "
      "more, \"boxstream man COMMAND | man -l -\" the same as a page of the manual. Colours are for terminals, and\n"
      "none where NO_COLOR is set.\n\n"
      "Exit code: 0; 1 if pairs or answers differ or the run fails; 2 for bad input, with one line on standard error.");

  Action chosen;
  for (const Command* const command : commands()) add_command(app, *command, chosen);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      std::ostringstream text;
      app.exit(error, text);
      print_help(text.str());
      return 0;
    }
    throw BadInput(explain(app, error));
  }
  return chosen();
}

}  // namespace boxstream::tool
