// SPDX-License-Identifier: MIT
#include "papers/hybrid/versions.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

#include "papers/hybrid/complete_case.hpp"
#include "papers/hybrid/hybrid.hpp"
#include "papers/hybrid/order.hpp"

namespace boxstream::papers {
namespace {

/// The bipartite case with structures of any kind, in place: the two initial calls of Hybrid.
template <class Element, class Trace>
void find_bipartite(Span<Element> a, Span<Element> b, const HybridOptions& options, Found found, Trace trace) {
  using Bipartite = Problem<Structures>;
  Search<Bipartite, SortToScan, Trace> search{Bipartite({}, Case::bipartite, 0, found), {}, options, trace};
  hybrid(search, a, b, minus_infinity, plus_infinity, 2, View::first);
  hybrid(search, b, a, minus_infinity, plus_infinity, 2, View::second);
}

std::vector<Cube> numbered(Span<const Cube> cubes) {
  std::vector<Cube> copies(cubes.begin(), cubes.end());
  for (std::size_t i = 0; i < copies.size(); ++i) copies[i].num = static_cast<std::int32_t>(i);
  return copies;
}

}  // namespace

static_assert(sizeof(Box) == 24, "figure 11");
static_assert(VersionOne::bytes_per_box == 36, "table 3");
static_assert(sizeof(NumberedBox) == 28, "figure 17");
static_assert(VersionTwo::bytes_per_box == 56, "table 3");
static_assert(VersionThree::bytes_per_box == 28, "table 3");
static_assert(sizeof(Cube) == 20, "figure 19");
static_assert(VersionFour::bytes_per_box == 20, "table 3");

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

void VersionOne::run_sorted(Procedure procedure, const HybridOptions& options, Found found) {
  run_complete(procedure, Pointers{boxes_.data()}, KeepSorted<Pointer>{temporary_.data()}, Span<Pointer>(intervals_),
               Span<Pointer>(points_), options, found);
}

void VersionOne::find_pairs_sorted(const HybridOptions& options, Found found) {
  run_sorted(Procedure::hybrid, options, found);
}

void VersionOne::find_pairs(Sorting sorting, const HybridOptions& options, Found found) {
  sort(sorting);
  find_pairs_sorted(options, found);
}

VersionTwo::VersionTwo(Span<const Box> boxes) : intervals_(numbered(boxes)), points_(intervals_) {}

void VersionTwo::find_pairs(const HybridOptions& options, Found found) {
  using Complete = Problem<Structures>;
  Search<Complete, SortToScan> search{Complete({}, Case::complete, 2, found), {}, options};
  hybrid(search, Span<NumberedBox>(intervals_), Span<NumberedBox>(points_), minus_infinity, plus_infinity, 2,
         View::first);
}

VersionThree::VersionThree(Span<const Box> a, Span<const Box> b) : a_(numbered(a)), b_(numbered(b)) {}

void VersionThree::find_pairs(const HybridOptions& options, Found found) {
  find_bipartite(Span<NumberedBox>(a_), Span<NumberedBox>(b_), options, found, NoTrace{});
}

void VersionThree::find_pairs(const HybridOptions& options, Found found, TreeTrace& trace) {
  find_bipartite(Span<NumberedBox>(a_), Span<NumberedBox>(b_), options, found, TraceReference{&trace});
}

VersionFour::VersionFour(Span<const Cube> a, Span<const Cube> b) : a_(numbered(a)), b_(numbered(b)) {}

void VersionFour::find_pairs(const HybridOptions& options, Found found) {
  find_bipartite(Span<Cube>(a_), Span<Cube>(b_), options, found, NoTrace{});
}

Cube bounding_cube(const Box& box) {
  Cube cube{};
  for (int d = 0; d < 3; ++d) {
    cube.lo[d] = box.projections[d].lo;
    cube.side = std::max(cube.side, box.projections[d].hi - box.projections[d].lo);
  }
  return cube;
}

std::vector<Cube> bounding_cubes(Span<const Box> boxes) {
  std::vector<Cube> cubes;
  for (const Box& box : boxes) cubes.push_back(bounding_cube(box));
  return cubes;
}

std::vector<Box> as_boxes(Span<const Cube> cubes) {
  std::vector<Box> boxes;
  for (const Cube& c : cubes)
    boxes.push_back({{{c.lo[0], c.lo[0] + c.side}, {c.lo[1], c.lo[1] + c.side}, {c.lo[2], c.lo[2] + c.side}}});
  return boxes;
}

}  // namespace boxstream::papers
