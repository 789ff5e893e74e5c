// SPDX-License-Identifier: MIT

#include "commands/commands.hpp"
#include "tables/plot.hpp"
#include "tables/speedup.hpp"

namespace boxstream::bench {

int run_plot(int argc, char** argv) {
  CLI::App app("Draws time over n, ours and every peer, both axes logarithmic, from a file written with --json.");
  std::string json, suite = "scaling", case_name = "U";
  std::vector<std::string> pictures;
  bool per_box = false, speedup = false;
  app.add_option("results", json, "the JSON file")->required();
  app.add_option("pictures", pictures, "files to write, ending in .svg or .png")->required();
  app.add_option("--suite", suite, "of the rows")->capture_default_str();
  app.add_option("--case", case_name, "of the rows")->capture_default_str();
  app.add_flag("--per-box", per_box, "nanoseconds a box instead of milliseconds");
  app.add_flag("--threads", speedup,
               "of suite scaling: speed against threads, measured and modelled, instead of time over n");
  if (const auto exit_code = parse(app, argc, argv)) return *exit_code;
  const Plot plot =
      speedup ? read_speedup(json, case_name)
              : read_plot(json, suite, case_name, per_box ? PlotValue::nanoseconds_per_box : PlotValue::milliseconds);
  for (const std::string& path : pictures) picture::write_plot(plot, path);
  return 0;
}

}  // namespace boxstream::bench
