// SPDX-License-Identifier: MIT
#include "papers/experiments/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "papers/experiments/rows.hpp"

namespace boxstream::papers {

Comparison::Comparison(const Settings& settings, std::string title, std::string unit, double units_per_ms)
    : settings_(settings), title_(std::move(title)), unit_(std::move(unit)), units_per_ms_(units_per_ms) {}

void Comparison::add(const Job& job) {
  struct Entrant {
    const StructureEntry* entry;
    std::unique_ptr<Structure> structure;
    std::vector<double> times;
  };
  std::vector<Entrant> contestants;
  for (const StructureEntry& entry : structures()) {
    if ((entry.works & job.works) == 0 || (entry.works & job.not_for) != 0) continue;
    contestants.push_back({&entry, entry.make(), {}});
    if (job.once) job.once(*contestants.back().structure);
  }
  PairSum expected;
  measure::interleave(
      contestants.size(), all_rounds(settings_.repeats), measure::Order::forwards, [](int) {},
      [&](int, std::size_t i) {
        Entrant& c = contestants[i];
        settings_.progress(fmt::format("{}, n = {}, {}", job.batch, job.n, c.entry->name));
        if (job.prepare) job.prepare(*c.structure);
        PairSum found;
        c.times.push_back(measure::time_once([&] { found = job.run(*c.structure); }));
        if (i == 0) expected = found;
        require_same(found, expected, std::string(c.entry->name));
        if (job.check) job.check(*c.structure, c.entry->works);
      });
  for (Entrant& c : contestants)
    add(std::string(c.entry->name), job.batch, job.n,
        measure::median(std::move(c.times)) * units_per_ms_ / job.operations, expected.pairs);
}

void Comparison::add(const std::string& structure, const std::string& batch, std::size_t n, double value,
                     std::uint64_t found) {
  // A clock may stand still for what takes less than its tick, and a plot's axis has no zero.
  results_.push_back({structure, batch, n, std::max(value, 1e-6), found});
}

std::vector<Comparison::Result> Comparison::of_set(const Result& like) const {
  std::vector<Result> set;
  for (const Result& r : results_)
    if (r.batch == like.batch && r.n == like.n) set.push_back(r);
  return set;
}

picture::Plot Comparison::plot() const {
  // The largest set decides which structures get a line: eight can be distinguished in a plot.
  const Result* largest = &results_.front();
  for (const Result& r : results_)
    if (r.batch == largest->batch && r.n > largest->n) largest = &r;
  std::vector<Result> best = of_set(*largest);
  std::stable_sort(best.begin() + 1, best.end(), [](const Result& x, const Result& y) { return x.value < y.value; });
  if (best.size() > 8) best.resize(8);
  std::vector<Row> rows;
  for (const Result& chosen : best)
    for (const Result& r : results_)
      if (r.structure == chosen.structure && r.batch == chosen.batch)
        rows.push_back({r.structure, r.n, static_cast<double>(r.n), r.value, r.found});
  return plot_of(rows, fmt::format("{}, batch {}", title_, largest->batch), "n, boxes", unit_);
}

Outcome Comparison::outcome() const {
  Outcome outcome;
  outcome.table.columns = {"structure", "batch", "n", unit_, "times the engine's", "found"};
  std::map<std::string, int> wins;
  std::size_t sets = 0;
  for (std::size_t i = 0; i < results_.size();) {
    std::vector<Result> set = of_set(results_[i]);
    const double engine = set.front().value;
    for (const Result& r : set)
      outcome.table.rows.push_back({r.structure, r.batch, std::to_string(r.n), fmt::format("{:.4g}", r.value),
                                    fmt::format("{:.3g}", r.value / engine), std::to_string(r.found)});
    i += set.size();
    std::stable_sort(set.begin(), set.end(), [](const Result& x, const Result& y) { return x.value < y.value; });
    std::string line = fmt::format("{}, n = {}:", set.front().batch, set.front().n);
    for (std::size_t place = 0; place < std::min<std::size_t>(3, set.size()); ++place)
      line += fmt::format("{} {} {:.3g}", place == 0 ? "" : ",", set[place].structure, set[place].value);
    outcome.findings.push_back(line);
    ++wins[set.front().structure];
    ++sets;
  }
  std::vector<std::pair<std::string, int>> ranking(wins.begin(), wins.end());
  std::stable_sort(ranking.begin(), ranking.end(), [](const auto& x, const auto& y) { return x.second > y.second; });
  std::string best = "best:";
  for (const auto& [name, count] : ranking)
    best += fmt::format("{} {} on {} of {}", name == ranking.front().first ? "" : ",", name, count, sets);
  outcome.findings.push_back(best);
  outcome.plots.push_back(plot());
  return outcome;
}

}  // namespace boxstream::papers
