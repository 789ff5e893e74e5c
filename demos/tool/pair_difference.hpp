// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/pair.hpp>
#include <optional>
#include <vector>

namespace boxstream::tool {

/// A pair that only one of two sets has.
struct PairDifference {
  Pair pair;
  bool in_first;
};

/// The least pair that only one of two sorted lists has; nothing if they are the same. A pair given twice in one list
/// and once in the other is a difference too.
std::optional<PairDifference> first_difference(const std::vector<Pair>& first, const std::vector<Pair>& second);

}  // namespace boxstream::tool
