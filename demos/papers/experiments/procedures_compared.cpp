// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/inputs.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/hybrid/procedures.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

namespace {

/// Boxes in order along dimension 0, as the figure's input is before the clock starts.
Input presorted(std::size_t n, std::uint64_t seed) {
  Input input = make_input("U", n, seed);
  std::sort(input.boxes.begin(), input.boxes.end(),
            [](const Box& a, const Box& b) { return a.projections[0].lo < b.projections[0].lo; });
  input.closed = closed(input.boxes);
  return input;
}

/// From which number of boxes on `rival` takes less time than OneWayScan.
std::string crossing(const std::vector<Row>& rows, const std::string& rival) {
  std::size_t from = 0;
  for (const Row& row : rows) {
    if (row.series != rival) continue;
    const auto scan = std::find_if(rows.begin(), rows.end(), [&](const Row& r) {
      return r.n == row.n && r.series == name(Procedure::one_way_scan);
    });
    if (row.value >= scan->value)
      from = 0;
    else if (from == 0)
      from = row.n;
  }
  return from == 0 ? fmt::format("{} is never faster than OneWayScan", rival)
                   : fmt::format("{} is faster than OneWayScan from {} boxes on", rival, from);
}

}  // namespace

/// Version One with its input in order: option 1 for all, and for Stream2-Scan a random point in place of ApproxMedian
/// too. Option 2 has Version Two's layout: numbered boxes, copied while the clock runs.
Outcome figure_6(const Settings& settings) {
  const std::vector<std::size_t> sizes =
      settings.quick ? std::vector<std::size_t>{500, 2000}
                     : std::vector<std::size_t>{10'000, 20'000, 40'000, 70'000, 100'000, 150'000, 200'000, 300'000};
  constexpr std::size_t all_pairs_limit = 20'000;
  const std::string scan_2(name(Procedure::stream2_scan)), no_median = scan_2 + ", random point",
                                                           option_2 = scan_2 + ", option 2";
  HybridOptions random_point;
  random_point.level.height = 0;
  std::vector<Row> rows;
  for (const std::size_t n : sizes) {
    const Input input = presorted(n, settings.seed);
    const Span<const Box> boxes(input.boxes);
    const Measured engine = measure_engine(settings.repeats, input.closed);
    rows.push_back({engine_name, n, static_cast<double>(n), engine.ms, engine.found.pairs});
    const auto add = [&](const std::string& series, const std::function<void(Found)>& search) {
      settings.progress(fmt::format("{}, n = {}", series, n));
      const Measured m = measure(settings.repeats, search);
      require_same(m.found, engine.found, series);
      rows.push_back({series, n, static_cast<double>(n), m.ms, m.found.pairs});
    };
    // Sorting pointers leaves the boxes where they are, so that places are the caller's numbers.
    VersionOne version{boxes};
    version.sort(VersionOne::Sorting::pointers);
    for (const Procedure procedure : procedures())
      if (procedure != Procedure::all_pairs || n <= all_pairs_limit)
        add(std::string(name(procedure)), [&](Found found) { version.run_sorted(procedure, {}, found); });
    add(no_median, [&](Found found) { version.run_sorted(Procedure::stream2_scan, random_point, found); });
    add(option_2, [&](Found found) { run(Procedure::stream2_scan, boxes, {}, found); });
  }
  std::vector<std::string> findings;
  for (const std::string& rival : {scan_2, no_median, option_2, std::string(name(Procedure::stream3))})
    findings.push_back(crossing(rows, rival));
  return outcome_of(rows, "boxes", "Figure 6: the procedures, Version One, presorted, balanced", "n, boxes",
                    std::move(findings));
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
