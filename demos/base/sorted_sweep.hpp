// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

/// The independent search that pairs are compared with: a sort along one axis.
namespace boxstream {

/// Calls `visit(Pair)`, a < b, for each touching pair among `numbers`, whose boxes `box_of(number)` are valid. Sorts
/// `numbers` by lower bounds on `axis`.
template <class BoxOf, class Visit>
void sorted_sweep(std::vector<std::uint32_t>& numbers, int axis, const BoxOf& box_of, const Visit& visit) {
  std::sort(numbers.begin(), numbers.end(),
            [&](std::uint32_t a, std::uint32_t b) { return box_of(a).min[axis] < box_of(b).min[axis]; });
  for (auto first = numbers.begin(); first != numbers.end(); ++first) {
    const auto& box = box_of(*first);
    for (auto second = first + 1; second != numbers.end() && box_of(*second).min[axis] <= box.max[axis]; ++second)
      if (overlaps(box, box_of(*second))) visit(Pair{std::min(*first, *second), std::max(*first, *second)});
  }
}

/// A pair that only one of two lists has.
struct PairDifference {
  Pair pair;
  bool in_first;
};

/// The least pair that only one of two sorted lists has; nothing if they are the same. A pair given twice in one list
/// and once in the other is a difference too.
inline std::optional<PairDifference> first_difference(const std::vector<Pair>& first, const std::vector<Pair>& second) {
  const auto [a, b] = std::mismatch(first.begin(), first.end(), second.begin(), second.end());
  if (a == first.end() && b == second.end()) return std::nullopt;
  const bool in_first = b == second.end() || (a != first.end() && *a < *b);
  return PairDifference{in_first ? *a : *b, in_first};
}

}  // namespace boxstream
