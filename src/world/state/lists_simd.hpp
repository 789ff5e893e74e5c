// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

#include "world/state/lists.hpp"

namespace boxstream::detail {

/// The inner loops of PairLists, on its arrays.

/// Clears the bits of those pairs found that are in the lists, writes the others to `fresh`, which has room for all,
/// and returns how many these are.
std::size_t confirm_pairs(Span<const Pair> found, const std::uint32_t* starts, const std::uint32_t* seconds,
                          std::uint64_t* expected, Pair* fresh);

/// Where pairs are in the lists, or would be.
void find_places(Span<const PairKey> pairs, const std::uint32_t* starts, const std::uint32_t* seconds,
                 std::uint32_t* places);

/// The first of the groups of 64 from `first` on that has `rank`, or `groups`.
std::size_t group_with(const std::uint32_t* ranks, std::size_t first, std::size_t groups, std::uint32_t rank);

}  // namespace boxstream::detail
