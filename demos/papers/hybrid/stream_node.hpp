// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <boxstream/span.hpp>

#include "papers/hybrid/approx_median.hpp"
#include "papers/hybrid/hybrid_search.hpp"

namespace boxstream::papers {

/// Step 5: where a node [lo, hi) is split, strictly between its ends. As printed, with the answer of ApproxMedian taken
/// as it is, the recursion need not end: an answer equal to lo leaves the left child without points and makes the right
/// one equal to its parent. Then the smallest low end above lo splits. With no such point, all are at lo, and the child
/// [lo, lo + 1) is what the paper calls an atomic segment.
template <class Search, class Element>
std::int32_t split_point(Search& search, Span<const Element> points, std::int32_t lo, int d) {
  const auto& problem = search.problem;
  const std::int32_t mi = approx_median(problem, points, search.options.level(points.size()), d, search.random);
  if (mi > lo) return mi;
  std::int32_t next = std::numeric_limits<std::int32_t>::max();
  for (const Element& p : points)
    if (problem.lo(p, d) > lo) next = std::min(next, problem.lo(p, d));
  return next == std::numeric_limits<std::int32_t>::max() ? lo + 1 : next;
}

/// Steps 4 to 8 of figure 5, one node [lo, hi) of the tree of dimension d, shared by Stream3, Stream2-Scan and Hybrid:
/// `spanning(Im, P)` is given what is settled in this dimension, `child(I, P, lo, hi)` the two halves.
/// Both sets are only rearranged.
template <class Search, class Element, class Spanning, class Child>
void stream_node(Search& search, Span<Element> intervals, Span<Element> points, std::int32_t lo, std::int32_t hi, int d,
                 View view, const Spanning& spanning, const Child& child) {
  const auto& problem = search.problem;
  const auto& order = search.order;

  // 4. [lo, hi) is within i. Points lie in [lo, hi), so all of them are within i too.
  const std::size_t m = order.part(
      intervals, [&](const Element& i) { return problem.begin(i, d, view) <= lo && hi <= problem.hi(i, d); });
  search.trace.spanning(m);
  if (m > 0) spanning(intervals.subspan(0, m), points);

  const Span<Element> rest = intervals.subspan(m, intervals.size() - m);
  // hi - lo may not be an int. In an atomic segment an interval that does not span contains no point.
  if (!rest.empty() && lo + 1 != hi) {
    const std::int32_t mi = split_point(search, Span<const Element>(points.data(), points.size()), lo, d);  // 5.
    const std::size_t left = order.part(points, [&](const Element& p) { return problem.lo(p, d) < mi; });

    // 6.
    std::size_t meeting =
        order.part(rest, [&](const Element& i) { return problem.begin(i, d, view) < mi && lo < problem.hi(i, d); });
    child(rest.subspan(0, meeting), points.subspan(0, left), lo, mi);
    order.join(problem, rest, meeting);

    // 7.
    meeting =
        order.part(rest, [&](const Element& i) { return problem.begin(i, d, view) < hi && mi < problem.hi(i, d); });
    child(rest.subspan(0, meeting), points.subspan(left, points.size() - left), mi, hi);
    order.join(problem, rest, meeting);
    order.join(problem, points, left);
  }
  order.join(problem, intervals, m);  // 8.
}

}  // namespace boxstream::papers
