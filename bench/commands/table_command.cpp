// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <filesystem>

#include "commands/commands.hpp"
#include "tables/results_table.hpp"

namespace boxstream::bench {

int run_table(int argc, char** argv) {
  CLI::App app("Prints the best peer of each case, and where it is faster, from files written with --json.");
  std::vector<std::string> files;
  std::string page;
  app.add_option("results", files, "JSON files; their rows are taken together")->required();
  app.add_option(
      "--into", page,
      "put the tables into this page, between its lines '<!-- results: begin -->' and '<!-- results: end -->'");
  bool of_frames = false;
  app.add_flag("--frames", of_frames, "the worst frames instead, in place of '<!-- frames: begin -->' and so on");
  if (const auto exit_code = parse(app, argc, argv)) return *exit_code;

  std::vector<Row> rows;
  std::string text;
  for (const std::string& file : files) {
    const ResultsFile results = read_results(file);
    rows.insert(rows.end(), results.rows.begin(), results.rows.end());
    text +=
        fmt::format("`{}`: {}.\n\n", std::filesystem::path(file).filename().string(), describe_run(results.machine));
  }
  text += of_frames ? frames_table(rows) : results_table(rows);
  put_or_print(page, of_frames ? "frames" : "results", text);
  return 0;
}

}  // namespace boxstream::bench
