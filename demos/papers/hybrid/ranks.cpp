// SPDX-License-Identifier: MIT
#include "papers/hybrid/ranks.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>

namespace boxstream::papers {

namespace {

template <class S>
struct End {
  S value;
  bool high;
  std::uint32_t box;
};

template <class S>
std::vector<Box> rank_all(Span<const BasicAabb<S>> boxes) {
  if (boxes.size() >= std::size_t{1} << 30) throw std::length_error("too many boxes for 32-bit ranks");
  for (const BasicAabb<S>& box : boxes)
    if (!is_valid(box)) throw std::invalid_argument("a box with a NaN or with min > max has no ranks");
  std::vector<Box> ranked(boxes.size());
  std::vector<End<S>> ends(2 * boxes.size());
  for (int d = 0; d < 3; ++d) {
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      ends[2 * i] = {boxes[i].min[d], false, i};
      ends[2 * i + 1] = {boxes[i].max[d], true, i};
    }
    // The box as last resort makes the ranks the same with every standard library.
    std::sort(ends.begin(), ends.end(), [](const End<S>& a, const End<S>& b) {
      if (a.value != b.value) return a.value < b.value;
      return a.high != b.high ? b.high : a.box < b.box;
    });
    for (std::size_t rank = 0; rank < ends.size(); ++rank) {
      Interval& interval = ranked[ends[rank].box].projections[d];
      (ends[rank].high ? interval.hi : interval.lo) = static_cast<std::int32_t>(rank);
    }
  }
  return ranked;
}

template <class S>
TwoSets rank_both(Span<const BasicAabb<S>> a, Span<const BasicAabb<S>> b) {
  std::vector<BasicAabb<S>> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  TwoSets sets{rank_all(Span<const BasicAabb<S>>(all)), {}};
  const auto middle = sets.a.begin() + static_cast<std::ptrdiff_t>(a.size());
  sets.b.assign(middle, sets.a.end());
  sets.a.erase(middle, sets.a.end());
  return sets;
}

}  // namespace

std::vector<Box> ranks(Span<const Aabb> boxes) {
  return rank_all(boxes);
}
std::vector<Box> ranks(Span<const Aabb64> boxes) {
  return rank_all(boxes);
}
TwoSets ranks(Span<const Aabb> a, Span<const Aabb> b) {
  return rank_both(a, b);
}
TwoSets ranks(Span<const Aabb64> a, Span<const Aabb64> b) {
  return rank_both(a, b);
}

}  // namespace boxstream::papers
