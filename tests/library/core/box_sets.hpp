// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "oracle.hpp"
#include "sanitized.hpp"

namespace boxstream::tests {

/// A named family of box sets: as many boxes as asked for, the same for the same seed on every machine.
template <class S>
struct BoxSet {
  std::string name;
  Boxes<S> (*make)(std::size_t n, std::uint64_t seed);
  /// Sizes beyond which the number of pairs, O(n^2) for some sets, makes a comparison slow.
  std::size_t largest = std::numeric_limits<std::size_t>::max();
  /// How many pairs a set of 2000 boxes (or of `largest`, if smaller) has, at least and at most.
  std::size_t fewest_pairs = 0;
  std::size_t most_pairs = 0;
  bool has_invalid = false;
};

/// Every family, in a fixed order.
template <class S>
const std::vector<BoxSet<S>>& box_sets();

/// The same without sanitizers; every sixth one under them. For tests that do much with each.
template <class S>
std::vector<BoxSet<S>> box_sets_to_repeat() {
  std::vector<BoxSet<S>> some;
  for (std::size_t i = 0; i < box_sets<S>().size(); i += sanitized ? 6 : 1) some.push_back(box_sets<S>()[i]);
  return some;
}

/// The family of that name; throws std::out_of_range if there is none.
template <class S>
const BoxSet<S>& box_set(const std::string& name);

}  // namespace boxstream::tests
