// SPDX-License-Identifier: MIT
#include "pair_difference.hpp"

#include <algorithm>

namespace boxstream::tool {

std::optional<PairDifference> first_difference(const std::vector<Pair>& first, const std::vector<Pair>& second) {
  const auto [a, b] = std::mismatch(first.begin(), first.end(), second.begin(), second.end());
  if (a == first.end() && b == second.end()) return std::nullopt;
  const bool in_first = b == second.end() || (a != first.end() && *a < *b);
  return PairDifference{in_first ? *a : *b, in_first};
}

}  // namespace boxstream::tool
