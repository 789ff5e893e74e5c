// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <boxstream/detector.hpp>
#include <exception>
#include <sstream>

#include "base/bad_file.hpp"
#include "base/output_file.hpp"
#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/command.hpp"
#include "boxstream/shared/machine.hpp"
#include "boxstream/shared/parse_error.hpp"
#include "boxstream/shared/print.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace {

namespace tool = boxstream::tool;

constexpr int exit_failure = 1;
constexpr int exit_bad_input = 2;

std::string version_text() {
  return fmt::format("boxstream {} (Bullet {}, {}, {})", boxstream::measure::library_version(), tool::bullet_version(),
                     boxstream::simd_target(), tool::compiler_name());
}

int run(int argc, char** argv) {
  tool::CommandLine app("Finds the pairs of axis-aligned boxes that touch, in physics scenes and in files.",
                        "boxstream");
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

  tool::Action chosen;
  for (const tool::Command* const command : tool::commands()) tool::add_command(app, *command, chosen);

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      std::ostringstream text;
      app.exit(error, text);
      tool::print_help(text.str());
      return 0;
    }
    throw tool::BadInput(tool::explain(app, error));
  }
  return chosen();
}

int complain(const char* reason, int code) {
  tool::complain(reason);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  boxstream::files::remove_parts_on_signals();
  try {
    return run(argc, argv);
  } catch (const tool::BadInput& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const boxstream::files::BadFile& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const boxstream::scenes::SceneError& error) {
    return complain(error.what(), exit_bad_input);
  } catch (const std::bad_alloc&) {
    return complain("out of memory", exit_failure);
  } catch (const std::exception& error) {
    return complain(error.what(), exit_failure);
  }
}
