// SPDX-License-Identifier: MIT
#include "papers/experiments/curve.hpp"

#include <fmt/format.h>

#include <memory>

#include "papers/hybrid/dimension_order.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

namespace {

HybridOptions with(Cutoffs cutoffs) {
  HybridOptions options;
  options.cutoffs = cutoffs;
  return options;
}

DimensionOrder order_for(const Settings& settings, Span<const Box> intervals, Span<const Box> points) {
  return settings.restart ? dividing_order(intervals, points, {}, settings.order) : settings.order;
}

}  // namespace

Subject version_three_on(const Settings& settings, BipartiteInput input) {
  const auto kept = std::make_shared<const BipartiteInput>(std::move(input));
  const Measured engine = measure_engine(settings.repeats, kept->a.closed, kept->b.closed);
  return {engine, [settings, kept, engine](int repeats, Cutoffs cutoffs) {
            const Span<const Box> a(kept->a.boxes), b(kept->b.boxes);
            const Measured m = measure(repeats, [&](Found found) {
              const DimensionOrder order = order_for(settings, a, b);
              if (order == DimensionOrder{}) return VersionThree(a, b).find_pairs(with(cutoffs), found);
              const auto seen_a = reordered(a, order), seen_b = reordered(b, order);
              VersionThree(seen_a, seen_b).find_pairs(with(cutoffs), found);
            });
            require_same(m.found, engine.found, "Version Three");
            return m;
          }};
}

Subject version_one_on(const Settings& settings, Input input) {
  const auto kept = std::make_shared<const Input>(std::move(input));
  const Measured engine = measure_engine(settings.repeats, kept->closed);
  return {engine, [settings, kept, engine](int repeats, Cutoffs cutoffs) {
            const Span<const Box> boxes(kept->boxes);
            std::vector<Box> seen = kept->boxes;
            const Measured m = measure(repeats, [&](Found found) {
              const DimensionOrder order = order_for(settings, boxes, boxes);
              if (order != DimensionOrder{}) seen = reordered(boxes, order);
              VersionOne(seen).find_pairs(VersionOne::Sorting::structures, with(cutoffs), found);
            });
            require_same({m.found.pairs, 0}, {engine.found.pairs, 0}, "Version One");
            VersionOne checked{Span<const Box>(seen)};
            require_same_boxes(checked, with(cutoffs), seen, kept->closed);
            return m;
          }};
}

Curve curve_over(const std::vector<std::size_t>& cutoffs, const Settings& settings, const Subject& subject,
                 std::size_t n, const std::string& series, const std::string& level, std::vector<Row>& rows) {
  Curve curve{subject.engine.ms};
  for (const std::size_t c : cutoffs) {
    settings.progress(fmt::format("{}, cutoff {}", series, c));
    const Measured m = subject.run(settings.repeats, Cutoffs(c));
    const Row row{series, n, static_cast<double>(c), m.ms, m.found.pairs};
    rows.push_back(row);
    if (curve.best.value == 0 || m.ms < curve.best.value) curve.best = row;
    if (m.ms > curve.worst.value) curve.worst = row;
    if (c == 2000) curve.at_2000 = m.ms;
  }
  for (const std::size_t c : {cutoffs.front(), cutoffs.back()})
    rows.push_back({fmt::format("{} {}", engine_name, level), n, static_cast<double>(c), subject.engine.ms,
                    subject.engine.found.pairs});
  return curve;
}

}  // namespace boxstream::papers
