// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include "papers/hybrid/problem.hpp"

namespace boxstream::papers {

/// OneWayScan(I, P, d), section 2: the pairs where the projection of i on dimension 0 contains the low end of p, and
/// that intersect in the dimensions 1 .. d. O(|I| + |P| + pairs met in dimension 0).
///
/// Both sets must be in the order of their low ends in dimension 0. The complete case is one call with I = P; the
/// bipartite case takes two, with the views exchanged.
template <class Access, class Element>
void one_way_scan(const Problem<Access>& problem, Span<const Element> intervals, Span<const Element> points, int d,
                  View view) {
  const Element* first = points.begin();
  for (const Element& i : intervals) {
    // A new pass begins where the last one found its first point, since low ends of intervals do not decrease either.
    while (first != points.end() && problem.lo(*first, 0) < problem.begin(i, 0, view)) ++first;
    for (const Element* p = first; p != points.end() && problem.lo(*p, 0) < problem.hi(i, 0); ++p)
      if (problem.intersect(i, *p, 1, d)) problem.report(i, *p, view);
  }
}

}  // namespace boxstream::papers
