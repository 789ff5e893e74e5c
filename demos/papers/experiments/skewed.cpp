// SPDX-License-Identifier: MIT
// Version Three on boxes that overlap in some dimensions: table 1, and what the order of the dimensions makes of it.
#include <fmt/format.h>

#include "papers/experiments/curve.hpp"
#include "papers/hybrid/procedures.hpp"

namespace boxstream::papers {

namespace {

struct Skewed {
  const char *batch, *powers;
};
constexpr Skewed family[] = {{"W1", "(1, 1, 0)"},     {"W2", "(1, 0, 1)"},     {"W3", "(0, 1, 1)"},
                             {"W4", "(1, 1/2, 1/2)"}, {"W5", "(1/2, 1, 1/2)"}, {"W6", "(1/2, 1/2, 1)"}};

const char* name(LowEnds low_ends) {
  return low_ends == LowEnds::alike ? "alike" : "differ";
}

std::string name(const Skewed& skewed) {
  return fmt::format("{} {}", skewed.batch[1], skewed.powers);
}

std::string name(DimensionOrder order) {
  return fmt::format("{}{}{}", order.of[0], order.of[1], order.of[2]);
}

/// TwoWayScan of all boxes, once: it takes seconds where dimension 0 tells nothing.
Measured scan(const Settings& settings, const BipartiteInput& input, const PairSum& expected) {
  const Measured m = measure(1, [&](Found found) {
    const auto a = reordered(input.a.boxes, settings.order), b = reordered(input.b.boxes, settings.order);
    run(Procedure::two_way_scan, Span<const Box>(a), Span<const Box>(b), {}, found);
  });
  require_same(m.found, expected, "TwoWayScan");
  return m;
}

/// Table 1 in one of its two readings. The row whose cutoff is n is the scan.
void skewed_curves(const Settings& settings, std::size_t n, LowEnds low_ends, std::vector<Row>& rows,
                   std::vector<std::string>& findings) {
  const std::vector<std::size_t> cutoffs =
      settings.quick ? std::vector<std::size_t>{8, 150} : std::vector<std::size_t>{8, 30, 150, 750, 2000, 8000};
  for (const Skewed& skewed : family) {
    const std::string series = fmt::format("{}, {}", name(skewed), name(low_ends));
    const BipartiteInput input = make_bipartite(skewed.batch, n, settings.seed, low_ends);
    const Subject subject = version_three_on(settings, input);
    const Curve curve =
        curve_over(cutoffs, settings, subject, n, series, fmt::format("{}, {}", skewed.batch[1], name(low_ends)), rows);
    settings.progress(series + ", scan");
    const Measured scanned = scan(settings, input, subject.engine.found);
    rows.push_back({series, n, static_cast<double>(n), scanned.ms, scanned.found.pairs});
    findings.push_back(fmt::format("{}: best cutoff {} with {:.3g} ms{}, scan {:.3g} ms; {} {:.3g} ms", series,
                                   curve.best.x, curve.best.value,
                                   curve.at_2000 > 0 ? fmt::format(", 2000 with {:.3g} ms", curve.at_2000) : "",
                                   scanned.ms, engine_name, curve.engine_ms));
  }
}

constexpr DimensionOrder orders[] = {{{0, 1, 2}}, {{0, 2, 1}}, {{1, 0, 2}}, {{1, 2, 0}}, {{2, 0, 1}}, {{2, 1, 0}}};

}  // namespace

Outcome table_1(const Settings& settings) {
  const std::size_t n = settings.quick ? 2000 : 100'000;
  std::vector<Row> all;
  Outcome outcome;
  for (const LowEnds low_ends : {LowEnds::alike, LowEnds::differ}) {
    std::vector<Row> rows;
    skewed_curves(settings, n, low_ends, rows, outcome.findings);
    const std::string title =
        fmt::format("Table 1: Version Three on skewed distributions, {} boxes; low ends {}", n, name(low_ends));
    outcome.plots.push_back(plot_of(rows, title, "cutoff (n: scan)", "milliseconds"));
    all.insert(all.end(), rows.begin(), rows.end());
  }
  outcome.table = table_of(all, "cutoff", "ms");
  return outcome;
}

/// Milliseconds in every order, and in that which a restart finds, at a low cutoff and at the balanced distribution's.
Outcome dimension_orders(const Settings& settings) {
  const std::size_t n = settings.quick ? 1000 : 100'000;
  const std::vector<std::size_t> cutoffs =
      settings.quick ? std::vector<std::size_t>{8, 100} : std::vector<std::size_t>{30, 2000};
  Outcome outcome;
  outcome.table.columns = {"input", "n", "low ends", "cutoff"};
  for (const DimensionOrder order : orders) outcome.table.columns.push_back(name(order));
  outcome.table.columns.insert(outcome.table.columns.end(), {"restart", "pairs"});
  const auto add = [&](const char* batch, const std::string& input_name, LowEnds low_ends) {
    const BipartiteInput input = make_bipartite(batch, n, settings.seed, low_ends);
    for (const std::size_t c : cutoffs) {
      settings.progress(fmt::format("{}, {}, cutoff {}", input_name, name(low_ends), c));
      std::vector<std::string> row = {input_name, std::to_string(n), name(low_ends), std::to_string(c)};
      const auto run_with = [&](DimensionOrder order, bool restart) {
        Settings chosen = settings;
        chosen.order = order;
        chosen.restart = restart;
        const Measured m = version_three_on(chosen, input).run(settings.repeats, Cutoffs(c));
        row.push_back(fmt::format("{:.4g}", m.ms));
        return m.found.pairs;
      };
      for (const DimensionOrder order : orders) run_with(order, false);
      row.push_back(std::to_string(run_with(settings.order, true)));
      outcome.table.rows.push_back(row);
    }
  };
  for (const LowEnds low_ends : {LowEnds::alike, LowEnds::differ})
    for (const Skewed& skewed : family) add(skewed.batch, name(skewed), low_ends);
  for (const char* const batch : {"U", "P", "Px", "R"}) add(batch, batch, LowEnds::alike);
  return outcome;
}

}  // namespace boxstream::papers
