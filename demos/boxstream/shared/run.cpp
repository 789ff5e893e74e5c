// SPDX-License-Identifier: MIT
#include "boxstream/shared/run.hpp"

#include <fmt/format.h>

#include <boxstream/detector.hpp>

#include "boxstream/shared/command.hpp"
#include "boxstream/shared/print.hpp"
#include "boxstream/shared/report.hpp"

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
  app.set_version_flag("--version", version_text(), "Print versions and exit");
  app.require_subcommand(1);
  app.footer(main_help(missing_commands()));

  Action chosen;
  for (const Command* const command : commands()) add_command(app, *command, chosen);

  if (const std::string help = parse(app, argc, argv); !help.empty()) {
    print_help(help);
    return 0;
  }
  return chosen();
}

}  // namespace boxstream::tool
