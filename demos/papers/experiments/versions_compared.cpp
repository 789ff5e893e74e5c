// SPDX-License-Identifier: MIT
// The versions against each other: figures 18, 20 and 21, and table 3.
#include <fmt/format.h>

#include "papers/experiments/experiment.hpp"
#include "papers/experiments/inputs.hpp"
#include "papers/experiments/measure.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

namespace {

std::vector<std::size_t> sizes_of(const Settings& settings) {
  if (settings.quick) return {2000, 4000};
  return {50'000, 100'000, 200'000, 300'000, 400'000, 500'000};
}

/// The paper's optimum for the balanced distribution at 100 000 boxes.
HybridOptions balanced_options() {
  HybridOptions options;
  options.cutoffs = Cutoffs(2000);
  return options;
}

Measured version_three(const Settings& settings, const std::vector<Box>& a, const std::vector<Box>& b) {
  return measure(settings.repeats, [&](Found found) {
    VersionThree(Span<const Box>(a), Span<const Box>(b)).find_pairs(balanced_options(), found);
  });
}

Measured version_four(const Settings& settings, const std::vector<Cube>& a, const std::vector<Cube>& b) {
  return measure(settings.repeats, [&](Found found) {
    VersionFour(Span<const Cube>(a), Span<const Cube>(b)).find_pairs(balanced_options(), found);
  });
}

/// Cubes of the balanced distribution: a box's corner, with its first length as side.
std::vector<Cube> cubes_of(const std::vector<Box>& boxes) {
  std::vector<Cube> cubes;
  for (const Box& box : boxes)
    cubes.push_back({{box.projections[0].lo, box.projections[1].lo, box.projections[2].lo},
                     box.projections[0].hi - box.projections[0].lo,
                     0});
  return cubes;
}

/// Adds what `series` took at n boxes. Throws std::runtime_error unless it found what `expected` has.
void add(std::vector<Row>& rows, const char* series, std::size_t n, const Measured& measured, const PairSum& expected) {
  require_same(measured.found, expected, series);
  rows.push_back({series, n, static_cast<double>(n), measured.ms, measured.found.pairs});
}

}  // namespace

Outcome figure_18(const Settings& settings) {
  std::vector<Row> rows, ratios;
  for (const std::size_t n : sizes_of(settings)) {
    settings.progress(fmt::format("n = {}", n));
    const Input input = make_input("U", n, settings.seed);
    const Measured engine = measure_engine(settings.repeats, input.closed);
    const Span<const Box> boxes(input.boxes);
    const Measured one = measure(settings.repeats, [&](Found found) {
      VersionOne(boxes).find_pairs(VersionOne::Sorting::structures, balanced_options(), found);
    });
    const Measured two =
        measure(settings.repeats, [&](Found found) { VersionTwo(boxes).find_pairs(balanced_options(), found); });
    add(rows, engine_name, n, engine, engine.found);
    // Version One has numbers of its own for the boxes.
    VersionOne checked{boxes};
    require_same_boxes(checked, balanced_options(), input.boxes, input.closed);
    add(rows, "Version One", n, {one.ms, {one.found.pairs, 0}}, {engine.found.pairs, 0});
    add(rows, "Version Two", n, two, engine.found);
    ratios.push_back({"t1 / t2", n, static_cast<double>(n), one.ms / two.ms, one.found.pairs});
  }
  Outcome outcome = outcome_of(rows, "boxes", "Versions One and Two, complete case, balanced", "n, boxes");
  outcome.plots.push_back(
      plot_of(ratios, "Figure 18: time of Version One over time of Version Two", "n, boxes", "t1 / t2"));
  outcome.plots.back().x = outcome.plots.back().y = picture::Axis::linear;
  for (const Row& row : ratios) outcome.findings.push_back(fmt::format("n = {}: t1 / t2 = {:.2f}", row.n, row.value));
  return outcome;
}

Outcome figure_20(const Settings& settings) {
  std::vector<Row> rows;
  std::vector<std::string> findings;
  for (const std::size_t n : sizes_of(settings)) {
    settings.progress(fmt::format("n = {}", n));
    const BipartiteInput input = make_bipartite("U", n, settings.seed);
    const auto a = cubes_of(input.a.boxes), b = cubes_of(input.b.boxes);
    const auto boxes_a = as_boxes(a), boxes_b = as_boxes(b);
    const Measured engine = measure_engine(settings.repeats, closed(boxes_a), closed(boxes_b));
    const Measured three = version_three(settings, boxes_a, boxes_b), four = version_four(settings, a, b);
    add(rows, engine_name, n, engine, engine.found);
    add(rows, "Version Three", n, three, engine.found);
    add(rows, "Version Four", n, four, engine.found);
    findings.push_back(
        fmt::format("n = {}: Version Four takes {:.0f} % of the time of Version Three (paper: about 86 %)", n,
                    100 * four.ms / three.ms));
  }
  return outcome_of(rows, "boxes", "Figure 20: cubes as cubes and as boxes, bipartite case", "n, boxes",
                    std::move(findings));
}

Outcome figure_21(const Settings& settings) {
  std::vector<Row> rows;
  std::vector<std::string> findings;
  for (const std::size_t n : sizes_of(settings)) {
    settings.progress(fmt::format("n = {}", n));
    const BipartiteInput input = make_bipartite("U", n, settings.seed);
    const Measured engine = measure_engine(settings.repeats, input.a.closed, input.b.closed);
    const auto a = bounding_cubes(input.a.boxes), b = bounding_cubes(input.b.boxes);
    const Measured engine_on_cubes = measure_engine(settings.repeats, closed(as_boxes(a)), closed(as_boxes(b)));
    const Measured three = version_three(settings, input.a.boxes, input.b.boxes), four = version_four(settings, a, b);
    add(rows, engine_name, n, engine, engine.found);
    add(rows, "boxstream, cubes", n, engine_on_cubes, engine_on_cubes.found);
    add(rows, "Version Three", n, three, engine.found);
    add(rows, "Version Four, cubes", n, four, engine_on_cubes.found);
    findings.push_back(
        fmt::format("n = {}: {} pairs of boxes, {} pairs of bounding cubes", n, three.found.pairs, four.found.pairs));
  }
  return outcome_of(rows, "boxes", "Figure 21: boxes, and cubes that bound them, bipartite case", "n, boxes",
                    std::move(findings));
}

Outcome table_3(const Settings&) {
  Outcome outcome;
  outcome.table.columns = {"version", "case", "objects", "bytes per object", "in the paper"};
  const auto add = [&](const char* version, const char* kind, const char* objects, std::size_t bytes, int paper) {
    outcome.table.rows.push_back({version, kind, objects, std::to_string(bytes), std::to_string(paper)});
  };
  add("One", "complete", "boxes", VersionOne::bytes_per_box, 36);
  add("Two", "complete", "boxes", VersionTwo::bytes_per_box, 56);
  add("Three", "bipartite", "boxes", VersionThree::bytes_per_box, 28);
  add("Four", "bipartite", "cubes", VersionFour::bytes_per_box, 20);
  return outcome;
}

}  // namespace boxstream::papers
