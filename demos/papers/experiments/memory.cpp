// SPDX-License-Identifier: MIT
// Table 2: the time to read and write an integer, by how much memory is visited.
#include <fmt/format.h>

#include <cstdint>
#include <stdexcept>
#include <utility>

#include "inputs/random.hpp"
#include "papers/experiments/experiment.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"

namespace boxstream::papers {

namespace {

/// What the paper strides over: 24 bytes, the structure of figure 11.
struct Place {
  std::uint32_t next, visits, rest[4];
};
static_assert(sizeof(Place) == 24);

void visit_in_order(std::vector<Place>& places) {
  for (Place& place : places) ++place.visits;
}

/// Each place says which is the next one, so that no visit begins before the last one has its answer.
void visit_by_next(std::vector<Place>& places) {
  std::uint32_t at = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    ++places[at].visits;
    at = places[at].next;
  }
}

/// One cycle through all places, in random order (Sattolo).
std::vector<Place> cycle_of(std::size_t n, std::uint64_t seed) {
  std::vector<Place> places(n);
  for (std::size_t i = 0; i < n; ++i) places[i].next = static_cast<std::uint32_t>(i);
  batches::Random random(seed);
  for (std::size_t i = n - 1; i > 0; --i)
    std::swap(places[i].next,
              places[static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(i) - 1))].next);
  return places;
}

/// Nanoseconds for one visit. Throws std::runtime_error unless each place was visited once in a pass.
double time_of(const Settings& settings, std::vector<Place>& places, void (*visit)(std::vector<Place>&)) {
  const std::size_t least_visits = settings.quick ? 1 << 16 : 1 << 24;
  const std::size_t passes = least_visits / places.size() + 1;
  for (Place& place : places) place.visits = 0;
  const double ms = measure_time(
      settings.repeats, [] {},
      [&] {
        for (std::size_t pass = 0; pass < passes; ++pass) visit(places);
      });
  for (const Place& place : places)
    if (place.visits != passes * static_cast<std::size_t>(settings.repeats))
      throw std::runtime_error("a place was not visited in every pass");
  return ms * 1e6 / static_cast<double>(passes * places.size());
}

}  // namespace

Outcome table_2(const Settings& settings) {
  std::vector<Row> rows;
  const std::size_t most = settings.quick ? 256 : 256 << 10;
  for (std::size_t kib = 8; kib <= most; kib *= 2) {
    settings.progress(fmt::format("{} KiB", kib));
    std::vector<Place> places = cycle_of(kib * 1024 / sizeof(Place), settings.seed);
    const auto x = static_cast<double>(kib);
    rows.push_back({"in order", places.size(), x, time_of(settings, places, visit_in_order), 0});
    rows.push_back({"one after the other at random", places.size(), x, time_of(settings, places, visit_by_next), 0});
  }
  Outcome outcome{table_of(rows, "KiB", "ns"), {}, {}, {}};
  outcome.plots.push_back(plot_of(rows, "Table 2: a read and a write, every 24 bytes", "KiB visited", "nanoseconds"));
  return outcome;
}

}  // namespace boxstream::papers
