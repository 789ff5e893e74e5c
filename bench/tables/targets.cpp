// SPDX-License-Identifier: MIT
#include "tables/targets.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include "tables/results_table.hpp"

namespace boxstream::bench {
namespace {

/// Names are separated and enclosed by blanks; a batch stands for itself, "*" for all. A peer's name is that of its
/// family; no peer: all but yardsticks.
struct Rule {
  std::string_view suite, cases;
  std::size_t lowest_n, highest_n;
  std::string_view peers;
  double factor;
};

constexpr std::string_view trees = " dbvt dbvt-deferred fcl-tree fcl-tree-array fcl-tree-float ";
constexpr std::string_view moving = " U:brown M:brown P:brown C:brown U:fall M:fall P:fall C:fall ";
constexpr std::string_view hard = " lattice scaffold heap rods ";
constexpr std::string_view few_many = " few-many:1 few-many:10 few-many:100 few-many:1000 ";
constexpr std::string_view static5 = " U:static5 M:static5 P:static5 C:static5 ";

constexpr Rule rules[] = {
    {"batch", " U D M P C ", 100000, 1000000, "", 12},
    {"batch", " S ", 100000, 1000000, "", 10},
    {"batch", " R ", 100000, 100000, " cgal ", 10},
    {"batch", " W1 W2 W3 ", 100000, 100000, " cgal ", 8},
    {"batch", " W1 W2 W3 ", 100000, 100000, " sweep ", 4},
    {"batch", " U D M P C S ", 10000, 10000, "", 8},
    {"batch", " U D M P C S ", 1000, 1000, "", 5},
    {"batch", "*", 10, 100, " brute ", 1},
    {"batch", "*", 8, 100, " bare-loop sorted-sweep ", 1.2},
    {"batch", hard, 100000, 1000000, " cgal version-two fcl-tree-float tree ", 3},
    {"sets", few_many, 100000, 1000000, " block-loop ", 1},
    {"sets", few_many, 100000, 1000000, " tree-of-few ", 3},
    {"sets", " turned ", 100000, 1000000, " two-trees tree-of-few ", 8},
    // At most 0.6 of the time without filters, and 1.2 of that for floats.
    {"sets", " static90 groups ", 10000, 1000000, " unfiltered ", 1 / 0.6},
    {"sets", " U64 S64 C64 ", 10000, 1000000, " float ", 1 / 1.2},
    {"sets", " flat64 voxels64 parcels64 cents64 mesh64 ", 1000, 1000000, " float ", 1 / 1.25},
    {"sets", " flat64:two voxels64:two cents64:two mesh64:two ", 1000, 1000000, " float ", 1 / 1.25},
    {"frames", moving, 100000, 100000, "", 6},
    {"frames", moving, 100000, 100000, " dbvt-deferred ", 30},
    {"frames", moving, 10000, 10000, "", 6},
    {"frames", moving, 10000, 10000, " dbvt-deferred ", 20},
    // At most 1.25 times as long as a new search in each frame.
    {"frames", " U:brown P:brown C:brown U:fall P:fall C:fall ", 1000, 100000, " detector ", 1 / 1.25},
    {"frames", static5, 100000, 100000, " dbvt dbvt-deferred ", 10},
    {"frames", static5, 10000, 10000, " dbvt dbvt-deferred ", 7},
    {"frames", " U:asleep M:asleep P:asleep C:asleep ", 100000, 100000, " dbvt dbvt-deferred ", 10},
    {"frames", " U:teleport M:teleport P:teleport C:teleport ", 100000, 100000, trees, 20},
    {"fcl", " U:small ", 1000, 100000, "", 3},
    {"fcl", " U:teleport ", 1000, 100000, "", 50},
    {"fcl", "*", 32, 100000, " fcl-tree ", 1},
    // Never slower, and faster where there are few.
    {"users", "*", 1, 300, "", 1.2},
    {"users", "*", 301, 100000000, "", 1},
    // The planner's choice takes at most a tenth longer than the best plan found by search.
    {"tune", "*", 100000, 100000, " plan ", 1 / 1.1},
    // At most four, and three, times the sort of n keys.
    {"scaling", " U ", 100000, 100000, " radix-sort ", 1.0 / 4},
    {"scaling", " U ", 1000000, 1000000, " radix-sort ", 1.0 / 3},
};

bool lists(std::string_view names, const std::string& name) {
  return names == "*" || names.find(' ' + name + ' ') != std::string_view::npos;
}

bool applies(const Rule& rule, const Row& row) {
  if (row.suite != rule.suite || row.threads != 1 || !row.skipped.empty() || !lists(rule.cases, row.case_name) ||
      row.n < rule.lowest_n || row.n > rule.highest_n)
    return false;
  return rule.peers.empty() ? !row.yardstick : lists(rule.peers, row.peer.substr(0, row.peer.find(':')));
}

}  // namespace

Plot read_speedup(const std::string& json_path, const std::string& case_name) {
  const ResultsFile results = read_results(json_path);
  Plot plot;
  for (const Row& row : results.rows) {
    if (row.suite != "scaling" || row.case_name != case_name || !row.skipped.empty()) continue;
    if (row.peer == serial_share) {
      PlotLine line{fmt::format("{} boxes, model", row.n), false, {}};
      for (double threads = 1; threads <= 64; threads *= 2)
        line.points.push_back({threads, amdahl(row.ratio(), threads)});
      plot.lines.push_back(line);
    } else if (row.peer == "one-thread") {
      PlotLine line{fmt::format("{} boxes, measured", row.n), true, {{1, 1}, {double(row.threads), row.ratio()}}};
      plot.lines.push_back(line);
    }
  }
  if (plot.lines.empty())
    throw std::runtime_error(fmt::format("{} has no rows of threads of case {}", json_path, case_name));
  const Machine& machine = results.machine;
  plot.small_print =
      fmt::format("{}, {}, {}, {}", machine.cpu, machine.compiler, machine.simd, machine.date.substr(0, 10));
  plot.unit = "times as fast as one thread";
  plot.x_label = "threads";
  plot.title = fmt::format("All pairs of n boxes: speed against threads, case {}", case_name);
  return plot;
}

std::vector<Target> check_targets(const std::vector<Row>& rows) {
  std::vector<Target> targets;
  for (const Rule& rule : rules) {
    const std::size_t first = targets.size();
    for (const Row& row : rows) {
      if (!applies(rule, row)) continue;
      const auto same =
          std::find_if(targets.begin() + static_cast<std::ptrdiff_t>(first), targets.end(),
                       [&](const Target& t) { return t.row->case_name == row.case_name && t.row->n == row.n; });
      if (same == targets.end())
        targets.push_back({rule.factor, &row});
      else if (row.ratio() < same->row->ratio())
        same->row = &row;
    }
  }
  return targets;
}

}  // namespace boxstream::bench
