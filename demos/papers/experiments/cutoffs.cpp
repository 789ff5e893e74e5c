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

Measured engine_on(const Settings& settings, const BipartiteInput& input) {
  return measure_engine(settings.repeats, input.a.closed, input.b.closed);
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
    const BipartiteInput input = make_bipartite(batch, n, settings.seed);
    const Measured engine = engine_on(settings, input);
    const std::string series = fmt::format("n = {}", n);
    Row best{}, worst{};
    for (const std::size_t c : cutoffs_of(settings)) {
      settings.progress(fmt::format("n = {}, cutoff {}", n, c));
      const Measured m = version_three(settings, input, Cutoffs(c));
      require_same(m.found, engine.found, "Version Three");
      rows.push_back({series, n, static_cast<double>(c), m.ms, m.found.pairs});
      if (best.value == 0 || m.ms < best.value) best = rows.back();
      if (m.ms > worst.value) worst = rows.back();
    }
    for (const std::size_t c : {cutoffs_of(settings).front(), cutoffs_of(settings).back()})
      rows.push_back({fmt::format("{} {}", engine_name, n), n, static_cast<double>(c), engine.ms, engine.found.pairs});
    outcome.findings.push_back(
        fmt::format("n = {}: best cutoff {} with {:.3g} ms, worst {} with {:.3g} ms; {} {:.3g} ms", n, best.x,
                    best.value, worst.x, worst.value, engine_name, engine.ms));
  }
  return outcome_of(rows, "cutoff", title, "cutoff", std::move(outcome.findings));
}

}  // namespace

Outcome figure_7(const Settings& settings) {
  const std::size_t n = settings.quick ? 4000 : 300'000;
  const std::vector<std::size_t> cutoffs =
      settings.quick ? std::vector<std::size_t>{10, 1000} : std::vector<std::size_t>{250, 500, 1000, 2000, 4000, 8000};
  const BipartiteInput input = make_bipartite("U", n, settings.seed);
  const Measured engine = engine_on(settings, input);
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
    const BipartiteInput input = make_bipartite(name, n, settings.seed);
    const Measured engine = engine_on(settings, input);
    Row best{}, paper{};
    for (const std::size_t c : cutoffs) {
      settings.progress(fmt::format("{}, cutoff {}", name, c));
      const Measured m = version_three(settings, input, Cutoffs(c));
      require_same(m.found, engine.found, "Version Three");
      rows.push_back({name, n, static_cast<double>(c), m.ms, m.found.pairs});
      if (best.value == 0 || m.ms < best.value) best = rows.back();
      if (c == 2000) paper = rows.back();
    }
    for (const std::size_t c : {cutoffs.front(), cutoffs.back()})
      rows.push_back(
          {fmt::format("{} {}", engine_name, name), n, static_cast<double>(c), engine.ms, engine.found.pairs});
    outcome.findings.push_back(fmt::format("{:2}: best cutoff {} with {:.3g} ms, 2000 with {:.3g} ms; {} {:.3g} ms",
                                           name, best.x, best.value, paper.value, engine_name, engine.ms));
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
    const BipartiteInput input = make_bipartite(skewed.batch, n, settings.seed);
    const Measured engine = engine_on(settings, input);
    const std::string series = fmt::format("{} {}", skewed.batch[1], skewed.powers);
    Row best{};
    double balanced = 0;
    for (const std::size_t c : cutoffs) {
      settings.progress(fmt::format("distribution {}, cutoff {}", series, c));
      const Measured m = version_three(settings, input, Cutoffs(c));
      require_same(m.found, engine.found, "Version Three");
      rows.push_back({series, n, static_cast<double>(c), m.ms, m.found.pairs});
      if (best.value == 0 || m.ms < best.value) best = rows.back();
      if (c == 2000) balanced = m.ms;
    }
    const double scan = rows.back().value;
    for (const std::size_t c : {cutoffs.front(), cutoffs.back()})
      rows.push_back({fmt::format("{} {}", engine_name, skewed.batch[1]), n, static_cast<double>(c), engine.ms,
                      engine.found.pairs});
    outcome.findings.push_back(
        fmt::format("distribution {}: best cutoff {} with {:.3g} ms{}, scan alone {:.3g} ms; {} {:.3g} ms", series,
                    best.x >= static_cast<double>(n) ? "scan" : fmt::format("{}", best.x), best.value,
                    balanced > 0 ? fmt::format(", 2000 with {:.3g} ms", balanced) : "", scan, engine_name, engine.ms));
  }
  return outcome_of(rows, "cutoff", fmt::format("Table 1: Version Three on skewed distributions, {} boxes", n),
                    "cutoff (the largest: scan)", std::move(outcome.findings));
}

}  // namespace boxstream::papers
