// SPDX-License-Identifier: MIT
#include "papers/hybrid/bipartite.hpp"
#include "papers/hybrid/numbered.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

static_assert(VersionThree::bytes_per_box == 28, "table 3");

VersionThree::VersionThree(Span<const Box> a, Span<const Box> b) : a_(numbered(a)), b_(numbered(b)) {}

void VersionThree::find_pairs(const HybridOptions& options, Found found) {
  find_bipartite(Span<NumberedBox>(a_), Span<NumberedBox>(b_), options, found, NoTrace{});
}

void VersionThree::find_pairs(const HybridOptions& options, Found found, TreeTrace& trace) {
  find_bipartite(Span<NumberedBox>(a_), Span<NumberedBox>(b_), options, found, TraceReference{&trace});
}

}  // namespace boxstream::papers
