// SPDX-License-Identifier: MIT
#include "boxstream/shared/run.hpp"

#include <fmt/format.h>

#include <boxstream/detector.hpp>

#include "boxstream/shared/command.hpp"
#include "boxstream/shared/machine.hpp"
#include "boxstream/shared/print.hpp"

namespace boxstream::tool {
namespace {

std::string version_text() {
  return fmt::format("boxstream {} (Bullet {}, {}, {})", measure::library_version(), bullet_version(), simd_target(),
                     compiler_name());
}

}  // namespace

char**& given_arguments() {
  static char** given = nullptr;
  return given;
}

int run(int argc, char** argv) {
  given_arguments() = argv;
  CommandLine app("Finds the pairs of axis-aligned boxes that touch, in physics scenes and in files.", "boxstream");
  app.add_version(version_text());
  app.require_below();
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

  if (const std::string help = app.parse(argc, argv); !help.empty()) {
    print_help(help);
    return 0;
  }
  return chosen();
}

}  // namespace boxstream::tool
