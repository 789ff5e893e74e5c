// SPDX-License-Identifier: MIT
// Version Three over its cutoffs: figures 7, 8 and 10, and table 1.
#include <fmt/format.h>

#include <cmath>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/inputs.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

namespace {

Measured version_three(const Settings& settings, const BipartiteInput& input, Cutoffs cutoffs) {
  HybridOptions options;
  options.cutoffs = cutoffs;
  return measure(settings.repeats, [&](Found found) {
    VersionThree(Span<const Box>(input.a.boxes), Span<const Box>(input.b.boxes)).find_pairs(options, found);
  });
}

/// Version Three over its cutoff, on one input.
struct Curve {
  double engine_ms;
  Row best{}, worst{}, last{};
  double at_2000 = 0;  ///< 0: not measured
};

/// Adds a row for each cutoff, and the engine as a level line from the first to the last, called `engine_name` and
/// `level`.
Curve curve_over(const std::vector<std::size_t>& cutoffs, const Settings& settings, const char* batch, std::size_t n,
                 const std::string& series, const std::string& level, std::vector<Row>& rows) {
  const BipartiteInput input = make_bipartite(batch, n, settings.seed);
  const Measured engine = measure_engine(settings.repeats, input.a.closed, input.b.closed);
  Curve curve{engine.ms};
  for (const std::size_t c : cutoffs) {
    settings.progress(fmt::format("{}, cutoff {}", series, c));
    const Measured m = version_three(settings, input, Cutoffs(c));
    require_same(m.found, engine.found, "Version Three");
    curve.last = {series, n, static_cast<double>(c), m.ms, m.found.pairs};
    rows.push_back(curve.last);
    if (curve.best.value == 0 || m.ms < curve.best.value) curve.best = curve.last;
    if (m.ms > curve.worst.value) curve.worst = curve.last;
    if (c == 2000) curve.at_2000 = m.ms;
  }
  for (const std::size_t c : {cutoffs.front(), cutoffs.back()})
    rows.push_back(
        {fmt::format("{} {}", engine_name, level), n, static_cast<double>(c), engine.ms, engine.found.pairs});
  return curve;
}

std::vector<std::size_t> cutoffs_of(const Settings& settings) {
  if (settings.quick) return {10, 100, 1000};
  return {30, 60, 125, 250, 500, 750, 1000, 1500, 2000, 3000, 4000, 8000, 16'000};
}

std::vector<std::size_t> sizes_of(const Settings& settings) {
  if (settings.quick) return {2000, 4000};
  return {50'000, 100'000, 200'000, 300'000, 400'000, 500'000};
}

/// Figures 8 and 10: a curve over the cutoff for every n, and the engine as a level line at each.
Outcome one_cutoff(const Settings& settings, const char* batch, const std::string& title) {
  std::vector<Row> rows;
  Outcome outcome;
  for (const std::size_t n : sizes_of(settings)) {
    const Curve curve =
        curve_over(cutoffs_of(settings), settings, batch, n, fmt::format("n = {}", n), std::to_string(n), rows);
    outcome.findings.push_back(
        fmt::format("n = {}: best cutoff {} with {:.3g} ms, worst {} with {:.3g} ms; {} {:.3g} ms", n, curve.best.x,
                    curve.best.value, curve.worst.x, curve.worst.value, engine_name, curve.engine_ms));
  }
  return outcome_of(rows, "cutoff", title, "cutoff", std::move(outcome.findings));
}

}  // namespace

Outcome figure_7(const Settings& settings) {
  const std::size_t n = settings.quick ? 4000 : 300'000;
  const std::vector<std::size_t> cutoffs =
      settings.quick ? std::vector<std::size_t>{10, 1000} : std::vector<std::size_t>{250, 500, 1000, 2000, 4000, 8000};
  const BipartiteInput input = make_bipartite("U", n, settings.seed);
  const Measured engine = measure_engine(settings.repeats, input.a.closed, input.b.closed);
  std::vector<Row> rows;
  for (const std::size_t second : cutoffs)
    for (const std::size_t first : cutoffs) {
      settings.progress(fmt::format("cutoffs {} and {}", first, second));
      const Measured m = version_three(settings, input, Cutoffs(first, second));
      require_same(m.found, engine.found, "Version Three");
      rows.push_back({fmt::format("second level {}", second), n, static_cast<double>(first), m.ms, m.found.pairs});
    }
  for (const std::size_t first : {cutoffs.front(), cutoffs.back()})
    rows.push_back({engine_name, n, static_cast<double>(first), engine.ms, engine.found.pairs});
  return outcome_of(rows, "cutoff of the first level",
                    fmt::format("Figure 7: Version Three, two cutoffs, {} boxes, balanced", n),
                    "cutoff of the first level");
}

Outcome figure_8(const Settings& settings) {
  Outcome outcome = one_cutoff(settings, "U", "Figure 8: Version Three over its cutoff, balanced");
  // Half of n points lie on n places, so that c of them are 2 c wide; the longest interval is n^(2/3).
  for (const std::size_t n : sizes_of(settings))
    outcome.findings.push_back(
        fmt::format("n = {}: intervals begin to span nodes below a cutoff of n^(2/3) / 2 = {:.0f}", n,
                    std::pow(static_cast<double>(n), 2.0 / 3) / 2));
  return outcome;
}

Outcome figure_10(const Settings& settings) {
  return one_cutoff(settings, "S", "Figure 10: Version Three over its cutoff, sphere");
}

Outcome other_batches(const Settings& settings) {
  const std::size_t n = settings.quick ? 1000 : 100'000;
  const std::vector<std::size_t> cutoffs =
      settings.quick ? std::vector<std::size_t>{30, 2000} : std::vector<std::size_t>{30, 150, 750, 2000, 8000};
  std::vector<Row> rows;
  Outcome outcome;
  for (const char* const name : {"D", "M", "P", "Px", "Py", "C", "R", "G", "T", "Z", "X"}) {
    const Curve curve = curve_over(cutoffs, settings, name, n, name, name, rows);
    outcome.findings.push_back(fmt::format("{:2}: best cutoff {} with {:.3g} ms, 2000 with {:.3g} ms; {} {:.3g} ms",
                                           name, curve.best.x, curve.best.value, curve.at_2000, engine_name,
                                           curve.engine_ms));
  }
  return outcome_of(rows, "cutoff", fmt::format("Version Three on other batches, {} boxes", n), "cutoff",
                    std::move(outcome.findings));
}

Outcome table_1(const Settings& settings) {
  struct Skewed {
    const char *batch, *powers;
  };
  constexpr Skewed family[] = {{"W1", "(1, 1, 0)"},     {"W2", "(1, 0, 1)"},     {"W3", "(0, 1, 1)"},
                               {"W4", "(1, 1/2, 1/2)"}, {"W5", "(1/2, 1, 1/2)"}, {"W6", "(1/2, 1/2, 1)"}};
  const std::size_t n = settings.quick ? 2000 : 100'000;
  const std::vector<std::size_t> cutoffs =
      settings.quick ? std::vector<std::size_t>{8, 150, n} : std::vector<std::size_t>{8, 30, 150, 750, 2000, 8000, n};
  std::vector<Row> rows;
  Outcome outcome;
  for (const Skewed& skewed : family) {
    const std::string series = fmt::format("{} {}", skewed.batch[1], skewed.powers);
    const Curve curve = curve_over(cutoffs, settings, skewed.batch, n, series, skewed.batch + 1, rows);
    outcome.findings.push_back(
        fmt::format("distribution {}: best cutoff {} with {:.3g} ms{}, scan alone {:.3g} ms; {} {:.3g} ms", series,
                    curve.best.x >= static_cast<double>(n) ? "scan" : fmt::format("{}", curve.best.x), curve.best.value,
                    curve.at_2000 > 0 ? fmt::format(", 2000 with {:.3g} ms", curve.at_2000) : "", curve.last.value,
                    engine_name, curve.engine_ms));
  }
  return outcome_of(rows, "cutoff", fmt::format("Table 1: Version Three on skewed distributions, {} boxes", n),
                    "cutoff (the largest: scan)", std::move(outcome.findings));
}

}  // namespace boxstream::papers
