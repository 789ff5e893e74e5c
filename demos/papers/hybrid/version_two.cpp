// SPDX-License-Identifier: MIT
#include "papers/hybrid/hybrid.hpp"
#include "papers/hybrid/numbered.hpp"
#include "papers/hybrid/order.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

static_assert(sizeof(NumberedBox) == 28, "figure 17");
static_assert(VersionTwo::bytes_per_box == 56, "table 3");

VersionTwo::VersionTwo(Span<const Box> boxes) : intervals_(numbered(boxes)), points_(intervals_) {}

void VersionTwo::find_pairs(const HybridOptions& options, Found found) {
  using Complete = Problem<Structures>;
  Search<Complete, SortToScan> search{Complete({}, Case::complete, 2, found), {}, options};
  hybrid(search, Span<NumberedBox>(intervals_), Span<NumberedBox>(points_), minus_infinity, plus_infinity, 2,
         View::first);
}

}  // namespace boxstream::papers
