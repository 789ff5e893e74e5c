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

/// What became of pairs: candidates, of which some are sure, and pairs that overlap.
struct Made {
  std::size_t doubtful = 0, sure = 0, overlapping = 0;
};

/// Makes candidates of pairs (a < b), held if they overlap. Those whose cores overlap are sure; they go to `sure`, the
/// others to `doubtful`, and pairs that overlap to `overlapping` as well. Each has room for all. Without cores none is
/// sure.
Made make_candidates(const Aabb* boxes, const Aabb* cores, const Pair* pairs, std::size_t count,
                     std::uint64_t* doubtful, std::uint64_t* sure, Pair* overlapping);
Made make_candidates(const Aabb64* boxes, const Aabb64* cores, const Pair* pairs, std::size_t count,
                     std::uint64_t* doubtful, std::uint64_t* sure, Pair* overlapping);

/// Writes which of so many fences overlap this one to `overlapping`, which has room for all, and counts them.
std::size_t find_overlapping(const Aabb* fences, std::size_t count, const Aabb& fence, std::uint32_t* overlapping);
std::size_t find_overlapping(const Aabb64* fences, std::size_t count, const Aabb64& fence, std::uint32_t* overlapping);

/// Writes which of so many boxes do not lie between their cores and their fences to `outside`, which has room for all,
/// and counts them. With a drift, three numbers between two zeros: not truly between where the two have drifted to; an
/// end without end is passed by one alike. `cores` may be null: then a box need only be within its fence.
std::size_t find_outside(const Aabb* fences, const Aabb* cores, const Aabb* boxes, std::size_t count,
                         const float* drift, std::uint32_t* outside);
std::size_t find_outside(const Aabb64* fences, const Aabb64* cores, const Aabb64* boxes, std::size_t count,
                         const double* drift, std::uint32_t* outside);

}  // namespace boxstream::detail
