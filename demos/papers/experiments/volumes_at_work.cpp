// SPDX-License-Identifier: MIT
// Every builder with every volume: what a hierarchy costs to have, what it does to find all pairs, and how long that
// takes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "inputs/batches.hpp"
#include "papers/experiments/experiment.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/experiments/volume_kinds.hpp"
#include "papers/volumes/builders.hpp"
#include "papers/volumes/query.hpp"
#include "papers/volumes/tightness.hpp"

namespace boxstream::papers {

namespace {

using namespace volumes;

double mean(const std::vector<double>& values) {
  double sum = 0;
  std::size_t count = 0;
  for (const double value : values)
    if (!std::isnan(value)) {
      sum += value;
      ++count;
    }
  return sum / static_cast<double>(count);
}

/// A line a volume, a point a builder.
picture::Plot plot_of_work(const std::vector<Row>& rows, const char* batch, std::size_t n) {
  picture::Plot plot = plot_of(rows, fmt::format("All pairs by traversal, batch {}, {} boxes", batch, n),
                               "volume tests a box, one point for each way to build", "ms");
  for (picture::PlotLine& line : plot.lines)
    std::sort(line.points.begin(), line.points.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  return plot;
}

}  // namespace

Outcome volumes_at_work(const Settings& settings) {
  const std::size_t n = settings.quick ? 100 : 4000;
  Outcome outcome;
  outcome.table.columns = {"batch",           "builder",   "volume",           "bytes",     "tree ms",
                           "volumes ms",      "refit ms",  "by children",      "by leaves", "volume tests a box",
                           "box tests a box", "search ms", "ns a volume test", "pairs"};
  for (const char* batch : {"D", "R"}) {
    const std::vector<Aabb> boxes = batches::make(batch, n, settings.seed);
    const Measured engine = measure_engine(settings.repeats, boxes);
    outcome.findings.push_back(
        fmt::format("{}: the engine finds the pairs in {:.3g} ms, from the boxes on", batch, engine.ms));
    const Objects objects = Objects::of(boxes);
    std::vector<Row> rows;
    double best = std::numeric_limits<double>::infinity();
    std::string best_name;
    for (const Builder builder : builders()) {
      Tree tree;
      const double tree_ms = measure_time(
          settings.repeats, [&] { tree = {}; }, [&] { tree = build(builder, objects); });
      for_each_volume([&]<class V>() {
        const std::string series = fmt::format("{}, {}", name(builder), V::name());
        settings.progress(fmt::format("{}, {}", batch, series));
        Hierarchy<V> hierarchy(tree, objects);
        const double volumes_ms = measure_time(
            settings.repeats, [] {}, [&] { Hierarchy<V>(tree, objects); });
        const VolumeTightness tightness = volume_tightness(hierarchy);
        Counts counts;
        PairSum found;
        const double search_ms = measure_time(
            settings.repeats,
            [&] {
              counts = {};
              found = {};
            },
            [&] {
              traverse(
                  hierarchy, hierarchy, Descent::one_side,
                  [&](std::uint32_t i, std::uint32_t j) { return overlaps(boxes[i], boxes[j]); },
                  [&](std::uint32_t i, std::uint32_t j) { found.add(i, j); }, counts);
            });
        require_same(found, engine.found, series);
        Counts refits;
        const double refit_ms = measure_time(
            settings.repeats, [] {}, [&] { hierarchy.refit(objects, refits); });
        const double tests = static_cast<double>(counts.volume_tests);
        outcome.table.rows.push_back(
            {batch, std::string(name(builder)), V::name(), std::to_string(sizeof(V)), fmt::format("{:.1f}", tree_ms),
             fmt::format("{:.1f}", volumes_ms), fmt::format("{:.1f}", refit_ms),
             fmt::format("{:.2f}", mean(tightness.by_children)), fmt::format("{:.3g}", tightness.by_leaves[0]),
             fmt::format("{:.1f}", tests / static_cast<double>(n)),
             fmt::format("{:.1f}", static_cast<double>(counts.primitive_tests) / static_cast<double>(n)),
             fmt::format("{:.2f}", search_ms), fmt::format("{:.1f}", search_ms * 1e6 / tests),
             std::to_string(found.pairs)});
        rows.push_back({V::name(), n, tests / static_cast<double>(n), search_ms, found.pairs});
        if (search_ms < best) {
          best = search_ms;
          best_name = series;
        }
      });
    }
    outcome.plots.push_back(plot_of_work(rows, batch, n));
    outcome.findings.push_back(fmt::format(
        "{}: the shortest search of a hierarchy, without building it, takes {:.3g} ms: {}", batch, best, best_name));
  }
  return outcome;
}

}  // namespace boxstream::papers
