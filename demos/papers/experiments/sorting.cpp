// SPDX-License-Identifier: MIT
// Section 6: what order in memory does to a search (figure 13), and to sorting itself (figures 14 and 15).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

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
  settings.progress(fmt::format("{} structures of {} bytes", n, size));
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
  for (std::size_t i = 0; i < n; ++i)
    if (sorted[i].key != source[pointers[i]].key)
      throw std::runtime_error("structures and pointers in different orders");
  rows.push_back({"structures", n, static_cast<double>(size), structures, 0});
  rows.push_back({"pointers", n, static_cast<double>(size), by_pointers, 0});
}

/// Two rows a size: structures, pointers.
std::vector<Row> sort_all_sizes(const Settings& settings, std::size_t n) {
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
  return rows;
}

/// The size up to which structures are cheaper to sort, between two sizes where the difference of times, taken to be
/// straight between them, is 0; the largest size measured if there is no such place.
double cross_over_size(const std::vector<Row>& rows) {
  const auto loss = [&](std::size_t i) { return rows[i].value - rows[i + 1].value; };
  for (std::size_t i = rows.size() - 2; i >= 2; i -= 2)
    if (loss(i) > 0 && loss(i - 2) <= 0)
      return rows[i - 2].x + (rows[i].x - rows[i - 2].x) * -loss(i - 2) / (loss(i) - loss(i - 2));
  return loss(0) > 0 ? rows.front().x : rows.back().x;
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
      require_same_boxes(version, options, input.boxes, input.closed);
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
  const std::size_t n = settings.quick ? 2000 : 100'000;
  Outcome outcome = outcome_of(sort_all_sizes(settings, n), "bytes", fmt::format("Figure 14: sorting {} structures", n),
                               "bytes per structure");
  outcome.plots.back().x = outcome.plots.back().y = picture::Axis::linear;
  return outcome;
}

Outcome figure_15(const Settings& settings) {
  const std::vector<std::size_t> sizes = settings.quick
                                             ? std::vector<std::size_t>{1000, 2000}
                                             : std::vector<std::size_t>{100'000, 200'000, 300'000, 400'000, 500'000};
  std::vector<Row> rows;
  for (const std::size_t n : sizes)
    rows.push_back({"cross-over", n, static_cast<double>(n), cross_over_size(sort_all_sizes(settings, n)), 0});
  Outcome outcome{table_of(rows, "structures", "bytes"), {}, {}, {}};
  outcome.plots.push_back(plot_of(rows, "Figure 15: cross-over size", "structures", "bytes"));
  outcome.plots.back().x = outcome.plots.back().y = picture::Axis::linear;
  return outcome;
}

}  // namespace boxstream::papers
