// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// A yardstick: the time to sort n keys once, which a search by sweeping cannot go below by much. Least significant
/// digit first, four passes of eight bits, over the low ends of the boxes along x, each with its index.
class RadixSort {
 public:
  /// Indices of the boxes in order of their low ends; valid until the next call. NaNs are not expected.
  Span<const std::uint64_t> sort(Span<const Aabb> boxes);

  /// The index in an element of the result.
  static std::uint32_t index(std::uint64_t element) { return static_cast<std::uint32_t>(element); }

 private:
  std::vector<std::uint64_t> elements_, scratch_;  // key in the high half, index in the low one
};

}  // namespace boxstream::bench
