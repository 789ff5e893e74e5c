// SPDX-License-Identifier: MIT
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include <boxstream/detector.hpp>

#include "commands/commands.hpp"
#include "inputs/batches.hpp"
#include "tables/measuring.hpp"
#include "tables/results_table.hpp"

namespace boxstream::bench {

namespace {

// Prices in nanoseconds on one AVX-512 machine, taken from profiles of U at 10^5 boxes; docs/internals/performance.md
// has them phase by phase.
constexpr double load_box = 1.9;         // read a box, as keys
constexpr double cut_record = 3.3;       // find its slabs, and count them
constexpr double scatter_copy = 2.2;     // write it to a slab
constexpr double leaf_record = 6.3;      // order, pack, columns, a block's beginning
constexpr double block_position = 1.15;  // 16 comparisons
constexpr double second_look = 1.0;      // at false hits, a box
constexpr double pair = 3.3;             // second look, writing, handing over
constexpr double sample_box = 45;
constexpr double search_plans = 22000;  // of two cuts, which only larger nodes try
constexpr double small_search = 8192;
constexpr double leaf = 300, node = 500, call = 300;
constexpr double bytes_beyond_cache = 168;  // of a box: read; written and read as a record, and again as 1.25 copies
constexpr double bytes_a_nanosecond = 12;   // of memory
constexpr double working_set = 88;          // bytes of a box: itself, a record, and one in a cell
constexpr double cache = 32e6;

struct Counts {
  double n, nodes, cells, records, tests, pairs;  // records, tests and pairs: of a box
};

double plan_cost(double boxes) {
  if (boxes <= 160) return 0;
  const double sample =
      boxes < small_search ? std::clamp(boxes / 16, 16.0, 64.0) : std::clamp(boxes / 128, 64.0, 512.0);
  return sample_box * sample + (boxes > small_search ? search_plans : 0);
}

/// Nanoseconds of a box. One node split is one cut of all boxes, more are two: what batches without large boxes get.
double model(const Counts& c) {
  const int levels = c.nodes == 0 ? 0 : c.nodes == 1 ? 1 : 2;
  const double after_first = levels == 2 ? std::sqrt(c.records) : c.records;
  const double records_cut = levels == 0 ? 0 : levels == 1 ? 1 : 1 + after_first;
  const double copies = levels == 0 ? 0 : levels == 1 ? c.records : after_first + c.records;
  double plans = plan_cost(c.n);
  if (levels == 2) plans += (c.nodes - 1) * plan_cost(c.n * after_first / (c.nodes - 1));
  const double beyond_cache = std::max(0.0, 1 - cache / (working_set * c.n));
  return load_box + cut_record * records_cut + scatter_copy * copies + leaf_record * c.records +
         block_position * c.tests / 16 + second_look + pair * c.pairs +
         (plans + leaf * c.cells + node * c.nodes + call) / c.n +
         bytes_beyond_cache / bytes_a_nanosecond * beyond_cache;
}

std::string row(const std::string& name, std::size_t n) {
  const std::vector<Aabb> boxes = batches::make(name, n, 1);
  Detector detector;
  std::vector<Pair> pairs;
  const Stats stats = detector.find_pairs(boxes, pairs);
  std::vector<double> searches;
  for (double spent = 0; searches.size() < 5 || spent < 100; spent += searches.back())
    searches.push_back(time_once([&] { detector.find_pairs(boxes, pairs); }));
  const double median = summarize(searches).median;
  const double size = static_cast<double>(n);
  const auto per_box = [&](std::uint64_t count) { return static_cast<double>(count) / size; };
  const Counts counts{size,
                      static_cast<double>(stats.nodes),
                      static_cast<double>(stats.cells),
                      per_box(stats.records),
                      per_box(stats.tests),
                      per_box(stats.pairs)};
  const double measured = 1e6 * median / size, expected = model(counts);
  return fmt::format("| {} | {} | {} | {} | {:.2f} | {:.0f} | {:.2f} | {:.1f} | {:.1f} | {:.2f} |\n", name, n,
                     stats.nodes, stats.cells, counts.records, counts.tests, counts.pairs, expected, measured,
                     measured / expected);
}

}  // namespace

int run_model(int argc, char** argv) {
  CLI::App app("Prints predictions of a model of the engine's cost and measurements, as a table in Markdown.");
  std::vector<std::string> cases{"U"};
  std::vector<double> sizes{1e3, 3e3, 1e4, 3e4, 1e5, 3e5, 1e6, 1e7};
  std::string page;
  app.add_option("--case", cases, "batches")->delimiter(',')->capture_default_str();
  app.add_option("--n", sizes, "numbers of boxes")->delimiter(',')->check(CLI::Range(1.0, 1e8));
  app.add_option("--into", page,
                 "put the table into this page, between its lines '<!-- model: begin -->' and '<!-- model: end -->'");
  if (const auto exit_code = parse(app, argc, argv)) return *exit_code;
  std::string text =
      "| input | n | nodes | leaves | records a box | tests a box | pairs a box | model, ns a box | measured | "
      "measured / "
      "model |\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|\n";
  for (const std::string& name : cases)
    for (const double n : sizes) text += row(name, static_cast<std::size_t>(n));
  put_or_print(page, "model", text);
  return 0;
}

}  // namespace boxstream::bench
