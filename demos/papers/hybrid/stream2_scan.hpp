// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/span.hpp>

#include "papers/hybrid/one_way_scan.hpp"
#include "papers/hybrid/stream_node.hpp"

namespace boxstream::papers {

/// What a streamed tree does with sets that need no further level: scan them in dimension 0.
template <class Search, class Element>
void scan_leaf(Search& search, Span<Element> intervals, Span<Element> points, View view) {
  search.order.before_scan(search.problem, intervals);
  search.order.before_scan(search.problem, points);
  one_way_scan(search.problem, Span<const Element>(intervals.data(), intervals.size()),
               Span<const Element>(points.data(), points.size()), 0, view);
}

/// Stream2-Scan, section 4: the tree has two levels, in dimensions 2 and 1; dimension 0 is scanned. Called like Hybrid.
template <class Search, class Element>
void stream2_scan(Search& search, Span<Element> intervals, Span<Element> points, std::int32_t lo, std::int32_t hi,
                  int d, View view) {
  if (intervals.empty() || points.empty() || hi <= lo) return;
  search.trace.enter(d == 0 ? Node::scanned : Node::streamed, d, intervals.size(), points.size());
  if (d == 0) {
    scan_leaf(search, intervals, points, view);
  } else {
    stream_node(
        search, intervals, points, lo, hi, d, view,
        [&](Span<Element> spanning, Span<Element> within) {
          stream2_scan(search, spanning, within, minus_infinity, plus_infinity, d - 1, view);
          stream2_scan(search, within, spanning, minus_infinity, plus_infinity, d - 1, other(view));
        },
        [&](Span<Element> i, Span<Element> p, std::int32_t from, std::int32_t to) {
          stream2_scan(search, i, p, from, to, d, view);
        });
  }
  search.trace.leave();
}

}  // namespace boxstream::papers
