// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>

namespace boxstream::detail {

/// Boxes are compared in groups of this size. A set of boxes of a group is a word with bit 6 * i for box i: the first
/// of the six bits of its bounds.
inline constexpr std::size_t compared_group = 8;
inline constexpr std::uint64_t whole_group = 0x41041041041;

/// For each of `groups` groups, which boxes of `now` have other bounds than those of `old` (the sign of zero does not
/// count, and NaNs differ if their bits do). Returns true if all boxes of `now` are valid.
/// Integers only: nothing depends on the floating-point environment.
bool compare_groups(const Aabb* old, const Aabb* now, std::size_t groups, std::uint64_t* changed);
bool compare_groups(const Aabb64* old, const Aabb64* now, std::size_t groups, std::uint64_t* changed);

/// True if two boxes differ by nothing but the signs of zeros.
bool differ_by_zeros(const Aabb& x, const Aabb& y);
bool differ_by_zeros(const Aabb64& x, const Aabb64& y);

}  // namespace boxstream::detail
