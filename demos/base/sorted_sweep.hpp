// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>
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
  // Copied in this order, and compared without branches: comparing neighbours takes nearly all of the time.
  std::vector<std::decay_t<decltype(box_of(std::uint32_t{}))>> boxes;
  boxes.reserve(numbers.size());
  const int y = (axis + 1) % 3, z = (axis + 2) % 3;
  const auto meets = [](const auto& a, const auto& b, int d) {
    return static_cast<int>(a.min[d] <= b.max[d]) & static_cast<int>(b.min[d] <= a.max[d]);
  };
  for (const std::uint32_t number : numbers) boxes.push_back(box_of(number));
  for (std::size_t first = 0; first < boxes.size(); ++first) {
    const auto& box = boxes[first];
    for (std::size_t second = first + 1; second < boxes.size() && boxes[second].min[axis] <= box.max[axis]; ++second)
      if (meets(box, boxes[second], y) & meets(box, boxes[second], z))
        visit(Pair{std::min(numbers[first], numbers[second]), std::max(numbers[first], numbers[second])});
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
