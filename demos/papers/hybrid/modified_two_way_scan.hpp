// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include "papers/hybrid/two_way_scan.hpp"

namespace boxstream::papers {

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
