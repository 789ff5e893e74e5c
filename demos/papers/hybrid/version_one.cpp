// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>

#include "papers/hybrid/hybrid.hpp"
#include "papers/hybrid/order.hpp"
#include "papers/hybrid/versions.hpp"

namespace boxstream::papers {

static_assert(sizeof(Box) == 24, "figure 11");
static_assert(VersionOne::bytes_per_box == 36, "table 3");

VersionOne::VersionOne(Span<const Box> boxes)
    : boxes_(boxes.begin(), boxes.end()), intervals_(boxes.size()), points_(boxes.size()), temporary_(boxes.size()) {}

void VersionOne::sort(Sorting sorting) {
  if (sorting == Sorting::structures)
    std::sort(boxes_.begin(), boxes_.end(),
              [](const Box& a, const Box& b) { return a.projections[0].lo < b.projections[0].lo; });
  std::iota(intervals_.begin(), intervals_.end(), Pointer{0});
  if (sorting == Sorting::pointers)
    std::sort(intervals_.begin(), intervals_.end(),
              [this](Pointer a, Pointer b) { return boxes_[a].projections[0].lo < boxes_[b].projections[0].lo; });
  points_ = intervals_;
}

void VersionOne::find_pairs_sorted(const HybridOptions& options, Found found) {
  using Complete = Problem<Pointers>;
  Search<Complete, KeepSorted<Pointer>> search{
      Complete({boxes_.data()}, Case::complete, 2, found), {temporary_.data()}, options};
  hybrid(search, Span<Pointer>(intervals_), Span<Pointer>(points_), minus_infinity, plus_infinity, 2, View::first);
}

void VersionOne::find_pairs(Sorting sorting, const HybridOptions& options, Found found) {
  sort(sorting);
  find_pairs_sorted(options, found);
}

}  // namespace boxstream::papers
