// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

#include <boxstream/span.hpp>

#include "papers/hybrid/hybrid.hpp"
#include "papers/hybrid/procedures.hpp"
#include "papers/hybrid/scans.hpp"
#include "papers/hybrid/stream3.hpp"

namespace boxstream::papers {

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
