// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::report {

/// How found pairs differ from the expected ones.
struct PairDifference {
  std::uint64_t missed = 0;      ///< expected, not found
  std::uint64_t extra = 0;       ///< found, not expected
  std::uint64_t duplicates = 0;  ///< found again

  /// Adds those of another comparison.
  void add(const PairDifference& other);
  /// Empty if there is none, or none but extra pairs where these are `allowed`.
  std::string complaint(bool extra_allowed) const;
};

/// `expected` is sorted and has nothing twice; `found` comes in any order.
PairDifference compare_pairs(Span<const Pair> expected, std::vector<Pair> found);

/// All pairs of valid boxes that touch, sorted: each box held against each.
template <class S>
std::vector<Pair> all_against_all(Span<const BasicAabb<S>> boxes) {
  std::vector<Pair> pairs;
  const auto n = static_cast<std::uint32_t>(boxes.size());
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a + 1; b < n; ++b)
      if (overlaps(boxes[a], boxes[b]) && is_valid(boxes[a]) && is_valid(boxes[b])) pairs.push_back({a, b});
  return pairs;
}

/// The expected pairs, sorted: all against all for up to 20000 boxes, beyond that by CGAL, or by a plain sweep where
/// CGAL is not built in.
std::vector<Pair> reference_pairs(Span<const Aabb> boxes);

}  // namespace boxstream::report
