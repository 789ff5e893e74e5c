// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include "papers/hybrid/problem.hpp"

namespace boxstream::papers {

/// Calls `met(i, p)` for all i and p whose projections on dimension 0 intersect. Both sets compete to be viewed as
/// intervals: the box with the lowest end of all that are left is activated, and meets what is left of the other set.
/// So each couple is met once, however ties are decided. Both sets must be in the order of their low ends there.
template <class Access, class Element, class Met>
void scan_both_ways(const Problem<Access>& problem, Span<const Element> intervals, Span<const Element> points,
                    const Met& met) {
  const Element* i = intervals.begin();
  const Element* p = points.begin();
  while (i != intervals.end() && p != points.end()) {
    if (problem.lo(*i, 0) <= problem.lo(*p, 0)) {
      for (const Element* q = p; q != points.end() && problem.lo(*q, 0) < problem.hi(*i, 0); ++q) met(*i, *q);
      ++i;
    } else {
      for (const Element* j = i; j != intervals.end() && problem.lo(*j, 0) < problem.hi(*p, 0); ++j) met(*j, *p);
      ++p;
    }
  }
}

/// TwoWayScan(A, B, d), section 2: the pairs that intersect in the dimensions 0 .. d.
/// It is made for the bipartite case. With A = B it meets each pair from both sides, and each box with itself.
template <class Access, class Element>
void two_way_scan(const Problem<Access>& problem, Span<const Element> a, Span<const Element> b, int d) {
  scan_both_ways(problem, a, b, [&](const Element& i, const Element& p) {
    if (problem.intersect(i, p, 1, d)) problem.report(i, p, View::first);
  });
}

}  // namespace boxstream::papers
