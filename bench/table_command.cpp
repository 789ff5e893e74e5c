// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>

#include "commands.hpp"
#include "results_table.hpp"

namespace boxstream::bench {

int run_table(int argc, char** argv) {
  CLI::App app("Prints what the project wants and got, and the best peers, from files written with --json.");
  std::vector<std::string> files;
  std::string page;
  app.add_option("results", files, "JSON files; their rows are taken together")->required();
  app.add_option(
      "--into", page,
      "put the tables into this page, between its lines '<!-- results: begin -->' and '<!-- results: end -->'");
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  std::vector<Row> rows;
  std::string text;
  for (const std::string& file : files) {
    for (Row& row : read_rows(file)) rows.push_back(std::move(row));
    text += fmt::format("`{}`: {}.\n\n", std::filesystem::path(file).filename().string(), describe_run(file));
  }
  text += results_table(rows);
  put_or_print(page, "results", text);
  return 0;
}

}  // namespace boxstream::bench
