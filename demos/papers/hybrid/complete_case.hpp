// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include <algorithm>
#include <cstdint>

#include "papers/hybrid/hybrid.hpp"
#include "papers/hybrid/procedures.hpp"
#include "papers/hybrid/scans.hpp"
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

/// The one that a streamed procedure begins with: the root of its tree.
template <class Search, class Element>
void stream(Procedure procedure, Search& search, Span<Element> i, Span<Element> p, View view) {
  if (procedure == Procedure::stream3) return stream3(search, i, p, minus_infinity, plus_infinity, 2, view);
  if (procedure == Procedure::stream2_scan) search.options.cutoffs = Cutoffs(0);
  hybrid(search, i, p, minus_infinity, plus_infinity, 2, view);
}

/// A procedure on one set, there twice: `intervals` and `points` are the same elements. Both are only rearranged. With
/// KeepSorted they must come in order.
template <class Access, class Order, class Element>
void run_complete(Procedure procedure, Access access, Order order, Span<Element> intervals, Span<Element> points,
                  const HybridOptions& options, Found found) {
  using Complete = Problem<Access>;
  const Span<const Element> seen(intervals.data(), intervals.size());
  switch (procedure) {
    case Procedure::all_pairs: {
      // Pointers in order along dimension 0 need not be in order of their numbers.
      const auto smaller_first = [&](std::uint32_t a, std::uint32_t b) { found(std::min(a, b), std::max(a, b)); };
      return all_pairs(Complete(access, Case::bipartite, 0, smaller_first), seen);
    }
    case Procedure::one_way_scan: {
      const Complete problem(access, Case::complete, 0, found);
      order.before_scan(problem, intervals);
      return one_way_scan(problem, seen, seen, 2, View::first);
    }
    case Procedure::two_way_scan: {
      // Each pair comes from both sides, and each box with itself.
      const auto once = [&](std::uint32_t a, std::uint32_t b) {
        if (a < b) found(a, b);
      };
      const Complete problem(access, Case::bipartite, 0, once);
      order.before_scan(problem, intervals);
      return two_way_scan(problem, seen, seen, 2);
    }
    case Procedure::modified_two_way_scan: {
      const Complete problem(access, Case::complete, 2, found);
      order.before_scan(problem, intervals);
      return modified_two_way_scan(problem, seen, seen, 2, View::first);
    }
    case Procedure::stream3:
    case Procedure::stream2_scan:
    case Procedure::hybrid: {
      Search<Complete, Order> search{Complete(access, Case::complete, 2, found), order, options};
      return stream(procedure, search, intervals, points, View::first);
    }
  }
}

}  // namespace boxstream::papers
