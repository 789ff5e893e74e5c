// SPDX-License-Identifier: MIT
#include "papers/hybrid/dimension_order.hpp"

#include <utility>

#include "papers/hybrid/box.hpp"
#include "papers/hybrid/order.hpp"
#include "papers/hybrid/stream_node.hpp"

namespace boxstream::papers {

namespace {

constexpr int levels_tried = 4;
constexpr double share_that_fails = 0.25;

using Probe = Search<Problem<Structures>, SortToScan>;

/// The couples of a point and an interval that meet in a node of the tree of dimension 2, `levels` below [lo, hi),
/// where an interval that spans a node meets all of its points.
double met_below(Probe& search, Span<NumberedBox> intervals, Span<NumberedBox> points, std::int32_t lo, std::int32_t hi,
                 int levels) {
  const auto couples = [](Span<NumberedBox> i, Span<NumberedBox> p) {
    return static_cast<double>(i.size()) * static_cast<double>(p.size());
  };
  if (levels == 0 || intervals.empty() || points.empty()) return couples(intervals, points);
  double met = 0;
  stream_node(
      search, intervals, points, lo, hi, 2, View::first,
      [&](Span<NumberedBox> spanning, Span<NumberedBox> within) { met += couples(spanning, within); },
      [&](Span<NumberedBox> i, Span<NumberedBox> p, std::int32_t from, std::int32_t to) {
        met += met_below(search, i, p, from, to, levels - 1);
      });
  return met;
}

bool divides(Span<const Box> intervals, Span<const Box> points, const HybridOptions& options, DimensionOrder order) {
  std::vector<NumberedBox> i = numbered(reordered(intervals, order)), p = numbered(reordered(points, order));
  const auto nothing = [](std::uint32_t, std::uint32_t) {};
  Probe search{Problem<Structures>({}, Case::bipartite, 2, nothing), {}, options};
  const double all = static_cast<double>(i.size()) * static_cast<double>(p.size());
  return met_below(search, i, p, minus_infinity, plus_infinity, levels_tried) <= share_that_fails * all;
}

DimensionOrder exchanged(DimensionOrder order, std::size_t a, std::size_t b) {
  std::swap(order.of[a], order.of[b]);
  return order;
}

}  // namespace

std::vector<Box> reordered(Span<const Box> boxes, DimensionOrder order) {
  std::vector<Box> seen(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t d = 0; d < 3; ++d) seen[i].projections[d] = boxes[i].projections[order.of[d]];
  return seen;
}

DimensionOrder dividing_order(Span<const Box> intervals, Span<const Box> points, const HybridOptions& options,
                              DimensionOrder first) {
  for (const DimensionOrder order : {first, exchanged(first, 1, 2), exchanged(first, 0, 2)})
    if (divides(intervals, points, options, order)) return order;
  return first;
}

}  // namespace boxstream::papers
