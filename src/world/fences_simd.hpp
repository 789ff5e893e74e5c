// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

namespace boxstream::detail {

/// The inner loops of Fences. All need the default floating-point environment. A candidate is the key of a pair and, in
/// the lowest bit, whether it is held.

/// Writes which of the candidates overlap without being held, or the other way round, to `changed`, which has room for
/// all, and returns how many these are.
std::size_t find_changed(const Aabb* boxes, const std::uint64_t* candidates, std::size_t count, std::uint32_t* changed);
std::size_t find_changed(const Aabb64* boxes, const std::uint64_t* candidates, std::size_t count,
                         std::uint32_t* changed);

/// Makes candidates of pairs (a < b), held if they overlap; these are written to `overlapping`, which has room for all,
/// and counted.
std::size_t make_candidates(const Aabb* boxes, const Pair* pairs, std::size_t count, std::uint64_t* candidates,
                            Pair* overlapping);
std::size_t make_candidates(const Aabb64* boxes, const Pair* pairs, std::size_t count, std::uint64_t* candidates,
                            Pair* overlapping);

/// Writes which of so many fences overlap this one to `overlapping`, which has room for all, and counts them.
std::size_t find_overlapping(const Aabb* fences, std::size_t count, const Aabb& fence, std::uint32_t* overlapping);
std::size_t find_overlapping(const Aabb64* fences, std::size_t count, const Aabb64& fence, std::uint32_t* overlapping);

/// Writes which of so many boxes are not within their fences to `outside`, which has room for all, and counts them.
/// With a drift, three numbers between two zeros: not truly inside where the fences have drifted to; an end without end
/// is inside of one alike.
std::size_t find_outside(const Aabb* fences, const Aabb* boxes, std::size_t count, const float* drift,
                         std::uint32_t* outside);
std::size_t find_outside(const Aabb64* fences, const Aabb64* boxes, std::size_t count, const double* drift,
                         std::uint32_t* outside);

}  // namespace boxstream::detail
