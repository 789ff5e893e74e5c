// SPDX-License-Identifier: MIT
#include "tables/speedup.hpp"

#include <fmt/core.h>

#include <stdexcept>

#include "tables/results_table.hpp"

namespace boxstream::bench {

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

}  // namespace boxstream::bench
