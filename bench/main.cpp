// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "batches/batches.hpp"
#include "suites.hpp"

namespace {

std::string known_batches() {
  std::string text = "Batches:\n";
  for (const auto& batch : boxstream::batches::all())
    text += "  " + std::string(batch.name) + std::string(4 - batch.name.size(), ' ') + std::string(batch.description) +
            "\n";
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace boxstream::bench;
  CLI::App app("Times boxstream beside its peers, interleaved in one run, and checks that the pairs are equal.");
  app.footer(known_batches());

  Options options;
  std::string suite = "all", json;
  std::vector<double> sizes;
  app.add_option("suite", suite, "which comparisons")->check(CLI::IsMember({"batch", "all"}))->capture_default_str();
  app.add_flag("--quick", options.quick, "fewer cases, sizes and rounds: under a minute");
  app.add_option("--json", json, "also write the rows to this file");
  app.add_option("--case", options.cases, "cases, as U,D,S")->delimiter(',');
  app.add_option("--n", sizes, "numbers of boxes, as 1000,1e6")->delimiter(',')->check(CLI::Range(1.0, 1e8));
  auto* repeats = app.add_option("--repeats", options.interleaving.repeats, "rounds (7; 3 with --quick)")
                      ->check(CLI::Range(1, 1000));
  app.add_option("--seed", options.seed, "seed of the generators")->capture_default_str();
  auto* limit =
      app.add_option("--limit", options.limit_seconds, "skip a peer predicted to take more seconds a run (10)")
          ->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }

  if (options.quick && !*repeats) options.interleaving.repeats = 3;
  if (options.quick && !*limit) options.limit_seconds = 1;
  for (const double n : sizes) options.sizes.push_back(static_cast<std::size_t>(n));

  try {
    for (const std::string& name : options.cases) boxstream::batches::find(name);
    Report report(describe_machine());
    {
      Progress progress;
      run_batch_suite(options, report, progress);
    }
    if (!json.empty()) report.write_json(json);
    if (report.failed()) std::puts("FAIL: pairs differ");
    return report.failed() ? 1 : 0;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "boxstream_bench: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "boxstream_bench: %s\n", error.what());
    return 1;
  }
}
