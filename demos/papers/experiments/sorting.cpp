// SPDX-License-Identifier: MIT
// Section 6: what order in memory does to a search (figure 13), and to sorting itself (figure 14).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "inputs/random.hpp"
#include "papers/experiments/experiment.hpp"
#include "papers/experiments/inputs.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

namespace {

/// A key with something to carry along, `size` bytes in all.
template <std::size_t size>
struct Structure {
  std::int32_t key;
  std::array<char, size - sizeof(std::int32_t)> load;
};

template <std::size_t size>
void sort_sizes(const Settings& settings, std::size_t n, std::vector<Row>& rows) {
  settings.progress(fmt::format("structures of {} bytes", size));
  static_assert(sizeof(Structure<size>) == size);
  batches::Random random(settings.seed);
  std::vector<Structure<size>> source(n);
  for (auto& structure : source) structure.key = static_cast<std::int32_t>(random.integer(0, 1 << 30));
  std::vector<Structure<size>> sorted;
  std::vector<Pointer> pointers(n);
  const auto by_key = [](const auto& a, const auto& b) { return a.key < b.key; };
  const double structures = measure_time(
      settings.repeats, [&] { sorted = source; }, [&] { std::sort(sorted.begin(), sorted.end(), by_key); });
  const double by_pointers = measure_time(
      settings.repeats, [&] { std::iota(pointers.begin(), pointers.end(), Pointer{0}); },
      [&] {
        std::sort(pointers.begin(), pointers.end(),
                  [&](Pointer a, Pointer b) { return source[a].key < source[b].key; });
      });
  rows.push_back({"structures", n, static_cast<double>(size), structures, 0});
  rows.push_back({"pointers", n, static_cast<double>(size), by_pointers, 0});
}

}  // namespace

Outcome figure_13(const Settings& settings) {
  const std::vector<std::size_t> sizes =
      settings.quick ? std::vector<std::size_t>{2000, 4000}
                     : std::vector<std::size_t>{50'000, 100'000, 200'000, 300'000, 400'000, 500'000};
  std::vector<Row> rows;
  Outcome outcome;
  for (const std::size_t n : sizes) {
    const Input input = make_input("U", n, settings.seed);
    const Measured engine = measure_engine(settings.repeats, input.closed);
    const auto x = static_cast<double>(n);
    rows.push_back({engine_name, n, x, engine.ms, engine.found.pairs});
    HybridOptions options;
    options.cutoffs = Cutoffs(2000);
    double searches[2];
    for (const auto sorting : {VersionOne::Sorting::structures, VersionOne::Sorting::pointers}) {
      const bool structures = sorting == VersionOne::Sorting::structures;
      const std::string what = structures ? "structures" : "pointers";
      settings.progress(fmt::format("{}, n = {}", what, n));
      // A fresh set each time, since a second sort would find the first one's order.
      VersionOne version{Span<const Box>(input.boxes)};
      const double sort = measure_time(
          settings.repeats, [&] { version = VersionOne{Span<const Box>(input.boxes)}; },
          [&] { version.sort(sorting); });
      const Measured search =
          measure(settings.repeats, [&](Found found) { version.find_pairs_sorted(options, found); });
      require_same({search.found.pairs, 0}, {engine.found.pairs, 0}, "Version One");
      rows.push_back({"sorting " + what, n, x, sort, 0});
      rows.push_back({"Hybrid after " + what, n, x, search.ms, search.found.pairs});
      searches[structures ? 0 : 1] = search.ms;
    }
    outcome.findings.push_back(
        fmt::format("n = {}: Hybrid takes {:.0f} % less after sorting structures (paper: up to 39 %)", n,
                    100 * (1 - searches[0] / searches[1])));
  }
  return outcome_of(rows, "boxes", "Figure 13: Version One, sorting structures or pointers", "n, boxes",
                    std::move(outcome.findings));
}

Outcome figure_14(const Settings& settings) {
  const std::size_t n = settings.quick ? 2000 : 500'000;
  std::vector<Row> rows;
  sort_sizes<8>(settings, n, rows);
  sort_sizes<16>(settings, n, rows);
  sort_sizes<24>(settings, n, rows);
  sort_sizes<32>(settings, n, rows);
  sort_sizes<48>(settings, n, rows);
  sort_sizes<64>(settings, n, rows);
  sort_sizes<96>(settings, n, rows);
  sort_sizes<128>(settings, n, rows);
  sort_sizes<192>(settings, n, rows);
  sort_sizes<256>(settings, n, rows);
  sort_sizes<384>(settings, n, rows);
  Outcome outcome =
      outcome_of(rows, "bytes", fmt::format("Figure 14: sorting {} structures", n), "bytes per structure");
  outcome.plots.back().x = outcome.plots.back().y = picture::Axis::linear;
  // The largest size that is cheaper to sort as structures: figure 15's "cross-over size", on this machine.
  double cross_over = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); i += 2)
    if (rows[i].value < rows[i + 1].value) cross_over = rows[i].x;
  outcome.findings.push_back(fmt::format("cross-over size at {} structures: {}{} bytes", n,
                                         cross_over == rows.back().x ? "at least " : "", cross_over));
  return outcome;
}

}  // namespace boxstream::papers
