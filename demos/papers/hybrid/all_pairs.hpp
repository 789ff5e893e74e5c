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

}  // namespace boxstream::papers
