// SPDX-License-Identifier: MIT
// Measures experiments, and writes their results as tables.
#include <fmt/format.h>
#include <malloc.h>

#include <cstdio>

#include <CLI/CLI.hpp>

#include "experiment_kinds/kinds.hpp"
#include "format/csv.hpp"
#include "measure/machine.hpp"
#include "measure/progress.hpp"

namespace {

using namespace boxstream::report;

struct Arguments {
  std::vector<std::string> files;
  std::string directory = "out/report";
  bool smoke = false;
  int repeats = 9;
};

void measure_one(const Arguments& arguments, const std::string& file) {
  const Experiment experiment = read_experiment(file, arguments.smoke);
  boxstream::measure::Progress line;
  const boxstream::measure::OtherLoad others;
  const Results results = run_experiment(experiment, arguments.repeats,
                                         [&](const std::string& what) { line.show(experiment.id + ": " + what); });
  const std::string command = fmt::format("./dev report {}{}", experiment.id, arguments.smoke ? " --smoke" : "") +
                              (arguments.repeats == 9 ? "" : fmt::format(" --repeats {}", arguments.repeats));
  write_results(arguments.directory, experiment, results, {command, arguments.repeats, others.processors()});
  std::size_t failed = 0;
  for (const Point& point : results.points) failed += !point.failure.empty();
  line.clear();
  fmt::print(stderr, "{}: {} points, {} failed: {}/{}.csv\n", experiment.id, results.points.size(), failed,
             arguments.directory, experiment.id);
}

/// Memory that was freed stays with the process. Else candidates pay for pages that those before them gave back: which
/// ones depends on the order.
void keep_memory() {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Measures experiments (bench/report/experiments/*.json) and writes a table of each. Exit code 2: an invalid "
      "experiment or option, for which no table was written.");
  Arguments arguments;
  app.add_option("experiments", arguments.files, "Files")->required()->check(CLI::ExistingFile);
  app.add_option("--into", arguments.directory, "Directory for the tables")->capture_default_str();
  app.add_flag("--smoke", arguments.smoke, "The few points of block \"smoke\", to see that all still runs");
  app.add_option("--repeats", arguments.repeats, "Timed runs of each candidate")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  keep_memory();
  try {
    for (const std::string& file : arguments.files) (void)kind_of(read_experiment(file, arguments.smoke));
    for (const std::string& file : arguments.files) measure_one(arguments, file);
  } catch (const BadExperiment& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
