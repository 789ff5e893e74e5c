// SPDX-License-Identifier: MIT
// Measures experiments, and writes what it found as tables.
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "csv.hpp"
#include "kinds.hpp"
#include "scene/scene_error.hpp"

namespace {

using namespace boxstream::report;

const NamedKind& kind_of(const Experiment& experiment) {
  std::string names;
  for (const NamedKind& kind : kinds()) {
    if (kind.name == experiment.kind) return kind;
    names += " " + kind.name;
  }
  throw BadExperiment(experiment.file + ": no kind \"" + experiment.kind + "\" here; there are:" + names);
}

/// A value that a scene cannot have is a mistake in the experiment.
Results results_of(const Experiment& experiment, const RunOptions& options, const Progress& progress) {
  try {
    return kind_of(experiment).run(experiment, options, progress);
  } catch (const boxstream::scenes::SceneError& error) {
    throw BadExperiment(experiment.file + ": " + error.what());
  }
}

struct Wish {
  std::vector<std::string> files;
  std::string directory = "out/report";
  bool smoke = false;
  int repeats = 9;
};

void measure(const Wish& wish, const std::string& file) {
  const Experiment experiment = read_experiment(file, wish.smoke);
  const bool terminal = isatty(STDERR_FILENO) != 0;
  const auto progress = [&](const std::string& what) {
    if (terminal) fmt::print(stderr, "\r\033[K{}: {}", experiment.id, what);
  };
  const Results results = results_of(experiment, {wish.repeats}, progress);
  const std::string command = fmt::format("./dev report {}{}", experiment.id, wish.smoke ? " --smoke" : "") +
                              (wish.repeats == 9 ? "" : fmt::format(" --repeats {}", wish.repeats));
  write_results(wish.directory, experiment, results, {command, wish.repeats});
  std::size_t failed = 0;
  for (const Point& point : results.points) failed += !point.failure.empty();
  fmt::print(stderr, "{}{}: {} points, {} failed: {}/{}.csv\n", terminal ? "\r\033[K" : "", experiment.id,
             results.points.size(), failed, wish.directory, experiment.id);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Measures experiments (report/experiments/*.json) and writes a table of each. Exit code 2: an experiment or an "
      "option that is not understood, and no table of it was written.");
  Wish wish;
  app.add_option("experiments", wish.files, "Files")->required()->check(CLI::ExistingFile);
  app.add_option("--into", wish.directory, "Directory for the tables")->capture_default_str();
  app.add_flag("--smoke", wish.smoke, "The few points of block \"smoke\", to see that all still runs");
  app.add_option("--repeats", wish.repeats, "Timed runs of each candidate")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  try {
    for (const std::string& file : wish.files) (void)kind_of(read_experiment(file, wish.smoke));
    for (const std::string& file : wish.files) measure(wish, file);
  } catch (const BadExperiment& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
