// SPDX-License-Identifier: MIT
// Versions Three and One over their cutoffs: figures 7, 8 and 10.
#include <fmt/format.h>

#include <cmath>

#include "papers/experiments/curve.hpp"

namespace boxstream::papers {

namespace {

std::vector<std::size_t> cutoffs_of(const Settings& settings) {
  if (settings.quick) return {10, 100, 1000};
  return {30, 60, 125, 250, 500, 750, 1000, 1500, 2000, 3000, 4000, 8000, 16'000};
}

std::vector<std::size_t> sizes_of(const Settings& settings) {
  if (settings.quick) return {2000, 4000};
  return {50'000, 100'000, 200'000, 300'000, 400'000, 500'000};
}

/// Figures 8 and 10: a curve over the cutoff for every n, and the engine as a level line at each.
Outcome one_cutoff(const Settings& settings, const std::string& title,
                   const std::function<Subject(std::size_t n)>& subject_of) {
  std::vector<Row> rows;
  Outcome outcome;
  for (const std::size_t n : sizes_of(settings)) {
    const Curve curve =
        curve_over(cutoffs_of(settings), settings, subject_of(n), n, fmt::format("n = {}", n), std::to_string(n), rows);
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
  const Subject subject = version_three_on(settings, make_bipartite("U", n, settings.seed));
  std::vector<Row> rows;
  for (const std::size_t second : cutoffs)
    for (const std::size_t first : cutoffs) {
      settings.progress(fmt::format("cutoffs {} and {}", first, second));
      const Measured m = subject.run(settings.repeats, Cutoffs(first, second));
      rows.push_back({fmt::format("second level {}", second), n, static_cast<double>(first), m.ms, m.found.pairs});
    }
  for (const std::size_t first : {cutoffs.front(), cutoffs.back()})
    rows.push_back({engine_name, n, static_cast<double>(first), subject.engine.ms, subject.engine.found.pairs});
  return outcome_of(rows, "cutoff of the first level",
                    fmt::format("Figure 7: Version Three, two cutoffs, {} boxes, balanced", n),
                    "cutoff of the first level");
}

Outcome figure_8(const Settings& settings) {
  Outcome outcome = one_cutoff(settings, "Figure 8: Version Three over its cutoff, balanced", [&](std::size_t n) {
    return version_three_on(settings, make_bipartite("U", n, settings.seed));
  });
  // Half of n points lie on n places, so that c of them are 2 c wide; the longest interval is n^(2/3).
  for (const std::size_t n : sizes_of(settings))
    outcome.findings.push_back(
        fmt::format("n = {}: intervals begin to span nodes below a cutoff of n^(2/3) / 2 = {:.0f}", n,
                    std::pow(static_cast<double>(n), 2.0 / 3) / 2));
  return outcome;
}

Outcome figure_10(const Settings& settings) {
  return one_cutoff(settings, "Figure 10: Version One over its cutoff, sphere",
                    [&](std::size_t n) { return version_one_on(settings, make_input("S", n, settings.seed)); });
}

Outcome other_batches(const Settings& settings) {
  const std::size_t n = settings.quick ? 1000 : 100'000;
  const std::vector<std::size_t> cutoffs =
      settings.quick ? std::vector<std::size_t>{30, 2000} : std::vector<std::size_t>{30, 150, 750, 2000, 8000};
  std::vector<Row> rows;
  Outcome outcome;
  for (const char* const name : {"D", "M", "P", "Px", "Py", "C", "R", "G", "T", "Z", "X"}) {
    const Curve curve = curve_over(
        cutoffs, settings, version_three_on(settings, make_bipartite(name, n, settings.seed)), n, name, name, rows);
    outcome.findings.push_back(fmt::format("{:2}: best cutoff {} with {:.3g} ms, 2000 with {:.3g} ms; {} {:.3g} ms",
                                           name, curve.best.x, curve.best.value, curve.at_2000, engine_name,
                                           curve.engine_ms));
  }
  return outcome_of(rows, "cutoff", fmt::format("Version Three on other batches, {} boxes", n), "cutoff",
                    std::move(outcome.findings));
}

}  // namespace boxstream::papers
