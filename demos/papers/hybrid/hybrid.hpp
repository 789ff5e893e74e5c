// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/span.hpp>

#include "papers/hybrid/scans.hpp"
#include "papers/hybrid/stream_node.hpp"

namespace boxstream::papers {

/// Hybrid(I, P, lo, hi, d), figure 5: Stream2-Scan that also scans wherever one of the two sets is smaller than the
/// cutoff c. Reports the pairs where i, in dimension d, contains the low end of p, and that intersect in the dimensions
/// below d. Both sets are only rearranged. With KeepSorted they must come in order, and leave in order. With cutoffs of
/// 0 it is Stream2-Scan of section 4: a tree of two levels, in dimensions 2 and 1, and scans in dimension 0.
///
/// Steps 2 and 3 are printed without a return; they end the call, or what they scan would be found again below.
/// Section 4 also has OneWayScan(I, P, d) for step 3 when sets are sorted to be scanned. As OneWayScan is defined that
/// misses the pairs where p contains i in dimension 0; scanning dimension d in its place would be right, but hardly any
/// two boxes of a node are apart there. Figure 5 and table 1 (distribution 3: scanning at once is best, since little
/// overlaps in dimension 0) mean what is done here.
template <class Search, class Element>
void hybrid(Search& search, Span<Element> intervals, Span<Element> points, std::int32_t lo, std::int32_t hi, int d,
            View view) {
  if (intervals.empty() || points.empty() || hi <= lo) return;  // 1.
  const std::size_t c = search.options.cutoffs.below[d];
  const Node kind = d == 0 ? Node::scanned : intervals.size() < c || points.size() < c ? Node::cut_off : Node::streamed;
  search.trace.enter(kind, d, intervals.size(), points.size());
  if (kind == Node::streamed) {  // 4. to 8.
    stream_node(
        search, intervals, points, lo, hi, d, view,
        [&](Span<Element> spanning, Span<Element> within) {
          hybrid(search, spanning, within, minus_infinity, plus_infinity, d - 1, view);
          hybrid(search, within, spanning, minus_infinity, plus_infinity, d - 1, other(view));
        },
        [&](Span<Element> i, Span<Element> p, std::int32_t from, std::int32_t to) {
          hybrid(search, i, p, from, to, d, view);
        });
  } else {
    search.order.before_scan(search.problem, intervals);
    search.order.before_scan(search.problem, points);
    const Span<const Element> i(intervals.data(), intervals.size()), p(points.data(), points.size());
    if (kind == Node::scanned)
      one_way_scan(search.problem, i, p, 0, view);  // 2.
    else
      modified_two_way_scan(search.problem, i, p, d, view);  // 3.
  }
  search.trace.leave();
}

}  // namespace boxstream::papers
