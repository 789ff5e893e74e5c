// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/inputs.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/hybrid/procedures.hpp"

namespace boxstream::papers {

Outcome figure_6(const Settings& settings) {
  const std::vector<std::size_t> sizes = settings.quick
                                             ? std::vector<std::size_t>{500, 2000}
                                             : std::vector<std::size_t>{10'000, 20'000, 40'000, 70'000, 100'000};
  constexpr std::size_t all_pairs_limit = 20'000;
  std::vector<Row> rows;
  for (const std::size_t n : sizes) {
    const Input input = make_input("U", n, settings.seed);
    const Measured engine = measure_engine(settings.repeats, input.closed);
    rows.push_back({engine_name, n, static_cast<double>(n), engine.ms, engine.found.pairs});
    for (const Procedure procedure : procedures()) {
      if (procedure == Procedure::all_pairs && n > all_pairs_limit) continue;
      const std::string series(name(procedure));
      settings.progress(fmt::format("{}, n = {}", series, n));
      const Measured m =
          measure(settings.repeats, [&](Found found) { run(procedure, Span<const Box>(input.boxes), {}, found); });
      require_same(m.found, engine.found, series);
      rows.push_back({series, n, static_cast<double>(n), m.ms, m.found.pairs});
    }
  }
  return outcome_of(rows, "boxes", "Figure 6: the procedures, complete case, balanced", "n, boxes");
}

Outcome median_heights(const Settings& settings) {
  const std::size_t n = settings.quick ? 2000 : 100'000;
  const Input input = make_input("U", n, settings.seed);
  const Measured engine = measure_engine(settings.repeats, input.closed);
  std::vector<Row> rows;
  for (const Procedure procedure : {Procedure::hybrid, Procedure::stream2_scan})
    for (int height = 0; height <= 9; ++height) {
      settings.progress(fmt::format("{}, height {}", name(procedure), height));
      HybridOptions options;
      options.level = {n, height};
      const Measured m =
          measure(settings.repeats, [&](Found found) { run(procedure, Span<const Box>(input.boxes), options, found); });
      require_same(m.found, engine.found, std::string(name(procedure)));
      rows.push_back({std::string(name(procedure)), n, static_cast<double>(height), m.ms, m.found.pairs});
    }
  Outcome outcome = outcome_of(rows, "height", fmt::format("Height of ApproxMedian at {} boxes, balanced", n),
                               "height of the tree of medians");
  outcome.plots.back().x = picture::Axis::linear;
  return outcome;
}

}  // namespace boxstream::papers
