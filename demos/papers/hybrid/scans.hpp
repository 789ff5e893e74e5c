// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include "papers/hybrid/problem.hpp"

namespace boxstream::papers {

/// AllPairs, section 2: each box of A against each box of B in all dimensions. O(n m), which no method beats when
/// everything intersects; the yardstick in tests.
template <class Access, class Element>
void all_pairs(const Problem<Access>& problem, Span<const Element> a, Span<const Element> b) {
  for (const Element& i : a)
    for (const Element& p : b)
      if (problem.intersect(i, p, 0, 2)) problem.report(i, p, View::first);
}

/// The complete case: each box against those behind it. `problem` must be bipartite, for a pair is met once only.
template <class Access, class Element>
void all_pairs(const Problem<Access>& problem, Span<const Element> boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t p = i + 1; p < boxes.size(); ++p)
      if (problem.intersect(boxes[i], boxes[p], 0, 2)) problem.report(boxes[i], boxes[p], View::first);
}

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

/// ModifiedTwoWayScan(I, P, d), section 4: the pairs where i, in dimension d, contains the low end of p, and that
/// intersect in the dimensions below d. Scans dimension 0 both ways, so that one order serves the scans of all levels.
/// For d >= 1.
template <class Access, class Element>
void modified_two_way_scan(const Problem<Access>& problem, Span<const Element> intervals, Span<const Element> points,
                           int d, View view) {
  scan_both_ways(problem, intervals, points, [&](const Element& i, const Element& p) {
    if (problem.contains(i, p, d, view) && problem.intersect(i, p, 1, d - 1)) problem.report(i, p, view);
  });
}

}  // namespace boxstream::papers
