// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>

#include "batches/batches.hpp"
#include "suites.hpp"

namespace boxstream::bench {

namespace {

struct Suite {
  std::string name;
  void (*run)(const Options& options, Report& report, Progress& progress);
  bool (*has_case)(const std::string& name);
};

const Suite suites[] = {
    {"batch", run_batch_suite, is_batch},   {"frames", run_frames_suite, is_frames_case},
#ifdef BOXSTREAM_BENCH_BULLET
    {"bullet", run_bullet_suite, is_scene},
#endif
    {"fcl", run_fcl_suite, is_fcl_case},    {"scaling", run_scaling_suite, is_batch},
};

std::string known_batches() {
  std::string text = "Cases of the batch suite:\n";
  for (const batches::Batch& batch : batches::all()) text += fmt::format("  {:<3} {}\n", batch.name, batch.description);
#ifdef BOXSTREAM_BENCH_BULLET
  text += "Cases of the bullet suite: the scenes in demos/scenes, such as pile and storm.\n";
#endif
  return text;
}

/// The suites to run, each with the cases that it knows. Throws std::invalid_argument for a case that none knows.
std::vector<std::pair<Suite, Options>> plan(const std::string& wanted, const Options& options) {
  std::vector<std::pair<Suite, Options>> planned;
  std::vector<std::string> unknown = options.cases;
  for (const Suite& suite : suites) {
    if (wanted != "all" && wanted != suite.name) continue;
    Options own = options;
    std::erase_if(own.cases, [&](const std::string& name) { return !suite.has_case(name); });
    std::erase_if(unknown, suite.has_case);
    if (options.cases.empty() || !own.cases.empty()) planned.push_back({suite, own});
  }
  if (!unknown.empty())
    throw std::invalid_argument(fmt::format("no case '{}' in suite {}; --help lists them", unknown.front(), wanted));
  return planned;
}

int run(int argc, char** argv) {
  CLI::App app("Times boxstream beside its peers, interleaved in one run, and checks that the pairs are equal.");
  app.footer(known_batches());

  std::vector<std::string> suite_names{"all"};
  for (const Suite& suite : suites) suite_names.push_back(suite.name);

  Options options;
  std::string suite = "all", json;
  std::vector<double> sizes;
  app.add_option("suite", suite, "which comparisons")->check(CLI::IsMember(suite_names))->capture_default_str();
  app.add_flag("--quick", options.quick, "fewer cases, sizes and rounds: under a minute");
  app.add_option("--json", json, "also write the rows to this file");
  app.add_option("--case", options.cases, "cases, as U,D,S")->delimiter(',');
  app.add_option("--n", sizes, "batch suite: numbers of boxes, as 1000,1e6")
      ->delimiter(',')
      ->check(CLI::Range(1.0, 1e8));
  app.add_option("--peer", options.peers, "peers, as cgal,sweep,brute or dbvt,dbvt-deferred,sap")->delimiter(',');
  auto* repeats = app.add_option("--repeats", options.interleaving.repeats, "batch suite: rounds (7; 3 with --quick)")
                      ->check(CLI::Range(1, 1000));
  app.add_option("--seed", options.seed, "batch suite: seed of the generators")->capture_default_str();
  auto* limit = app.add_option("--limit", options.limit_seconds,
                               "batch suite: skip a peer predicted to take more seconds a run (10; 1 with --quick)")
                    ->check(CLI::PositiveNumber);
  auto* frames = app.add_option("--frames", options.frames, "frames suite: frames of each case (60; 10 with --quick)")
                     ->check(CLI::Range(1, 1000000));
  app.add_option("--steps", options.steps, "bullet suite: steps (as the scene says; 120 with --quick)")
      ->check(CLI::Range(1, 1000000));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  if (options.quick && !*repeats) options.interleaving.repeats = 3;
  if (options.quick && !*limit) options.limit_seconds = 1;
  if (options.quick && !*frames) options.frames = 10;
  for (const double n : sizes) options.sizes.push_back(static_cast<std::size_t>(n));

  if (suite == "all" && !options.peers.empty())
    throw std::invalid_argument("--peer needs a suite: each has peers of its own");
  const auto planned = plan(suite, options);
  Report report(describe_machine());
  Progress progress;
  for (const auto& [chosen, own] : planned) chosen.run(own, report, progress);
  if (!json.empty()) report.write_json(json);
  if (report.failed()) std::puts("FAIL: pairs differ");
  return report.failed() ? 1 : 0;
}

}  // namespace

}  // namespace boxstream::bench

int main(int argc, char** argv) {
  try {
    return boxstream::bench::run(argc, argv);
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "boxstream_bench: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "boxstream_bench: %s\n", error.what());
    return 1;
  }
}
