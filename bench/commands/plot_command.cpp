// SPDX-License-Identifier: MIT

#include <optional>

#include "commands/commands.hpp"
#include "tables/plot.hpp"
#include "tables/speedup.hpp"

namespace boxstream::bench {

int run_plot(int argc, char** argv) {
  CLI::App app("Draws time over n, ours and every peer, both axes logarithmic, from a file written with --json.");
  std::string json, suite = "scaling", case_name = "U";
  std::vector<std::string> pictures, peers;
  std::optional<std::string> title;
  double most = 1e18;
  bool per_box = false, speedup = false, dark = false;
  app.add_option("results", json, "the JSON file")->required();
  app.add_option("pictures", pictures, "files to write, ending in .svg or .png")->required();
  app.add_option("--suite", suite, "of the rows")->capture_default_str();
  app.add_option("--case", case_name, "of the rows")->capture_default_str();
  app.add_option("--peer", peers, "only this one, as NAME=WORDS or NAME; may be given several times");
  app.add_option("--most", most, "boxes: leaves out what is beyond");
  app.add_option("--title", title, "instead of the names of suite and case");
  app.add_flag("--dark", dark, "for dark pages");
  app.add_flag("--per-box", per_box, "nanoseconds a box instead of milliseconds");
  app.add_flag("--threads", speedup,
               "of suite scaling: speed against threads, measured and modelled, instead of time over n");
  if (const auto exit_code = parse(app, argc, argv)) return *exit_code;
  std::vector<NamedPeer> named;
  for (const std::string& peer : peers) {
    const std::size_t end = peer.find('=');
    named.push_back({peer.substr(0, end), peer.substr(end == std::string::npos ? 0 : end + 1)});
  }
  Plot plot =
      speedup ? read_speedup(json, case_name)
              : read_plot(json, suite, case_name, per_box ? PlotValue::nanoseconds_per_box : PlotValue::milliseconds,
                          named, static_cast<std::size_t>(most));
  if (title) plot.title = *title;
  plot.dark = dark;
  for (const std::string& path : pictures) picture::write_plot(plot, path);
  return 0;
}

}  // namespace boxstream::bench
