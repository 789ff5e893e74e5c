// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <boxstream/span.hpp>

#include "papers/hybrid/stream_node.hpp"

namespace boxstream::papers {

/// Stream3, section 3: a segment tree of three levels, streamed. O((n + m) log^3(n + m) + k) time and O(n + m) space.
/// Called like Hybrid.
template <class Search, class Element>
void stream3(Search& search, Span<Element> intervals, Span<Element> points, std::int32_t lo, std::int32_t hi, int d,
             View view) {
  if (intervals.empty() || points.empty() || hi <= lo) return;
  search.trace.enter(Node::streamed, d, intervals.size(), points.size());
  stream_node(
      search, intervals, points, lo, hi, d, view,
      [&](Span<Element> spanning, Span<Element> within) {
        if (d == 0) {
          for (const Element& i : spanning)
            for (const Element& p : within) search.problem.report(i, p, view);
          return;
        }
        stream3(search, spanning, within, minus_infinity, plus_infinity, d - 1, view);
        stream3(search, within, spanning, minus_infinity, plus_infinity, d - 1, other(view));
      },
      [&](Span<Element> i, Span<Element> p, std::int32_t from, std::int32_t to) {
        stream3(search, i, p, from, to, d, view);
      });
  search.trace.leave();
}

}  // namespace boxstream::papers
