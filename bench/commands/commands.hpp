// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <CLI/CLI.hpp>

namespace boxstream::bench {

/// Parses arguments. Returns the exit code if the program is to end: 0 after help, 2 for bad arguments.
inline std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
}

// Commands of boxstream_bench beside running suites. Each parses its own arguments (argv[0] is its name) and returns
// the exit code.

/// Draws rows of a JSON file. Present only where the picture library is built (BOXSTREAM_BENCH_PLOT).
int run_plot(int argc, char** argv);

/// Prints the predictions of a model of the engine's cost beside measurements.
int run_model(int argc, char** argv);

/// Near neighbours beside CGAL's Delaunay triangulation. Present only where CGAL is (BOXSTREAM_BENCH_NEAR).
int run_near(int argc, char** argv);

/// Searches of more boxes than fit in memory, beside searches in memory.
int run_large(int argc, char** argv);

/// Prints rows of JSON files as tables in Markdown, or puts them into a page.
int run_table(int argc, char** argv);

/// Searches for bad batches, and replays them.
int run_worst(int argc, char** argv);

}  // namespace boxstream::bench
