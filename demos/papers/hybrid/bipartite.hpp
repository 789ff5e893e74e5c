// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>

#include "papers/hybrid/access.hpp"
#include "papers/hybrid/hybrid.hpp"
#include "papers/hybrid/order.hpp"

namespace boxstream::papers {

/// The bipartite case with structures of any kind, in place: the two initial calls of Hybrid.
template <class Element, class Trace>
void find_bipartite(Span<Element> a, Span<Element> b, const HybridOptions& options, Found found, Trace trace) {
  using Bipartite = Problem<Structures>;
  Search<Bipartite, SortToScan, Trace> search{Bipartite({}, Case::bipartite, 0, found), {}, options, trace};
  hybrid(search, a, b, minus_infinity, plus_infinity, 2, View::first);
  hybrid(search, b, a, minus_infinity, plus_infinity, 2, View::second);
}

}  // namespace boxstream::papers
