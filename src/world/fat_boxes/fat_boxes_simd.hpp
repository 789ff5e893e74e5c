// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

namespace boxstream::detail {

/// The inner loops of FatBoxes. All need the default floating-point environment. A candidate is the key of a pair and,
/// in the lowest bit, whether it is held.

/// Writes the indices of candidates whose held bit differs from whether their boxes overlap to `changed`, which has
/// room for all. Returns their number.
std::size_t find_changed(const Aabb* boxes, const std::uint64_t* candidates, std::size_t count, std::uint32_t* changed);
std::size_t find_changed(const Aabb64* boxes, const std::uint64_t* candidates, std::size_t count,
                         std::uint32_t* changed);

/// Numbers of elements that `make_candidates` wrote.
struct CandidateCounts {
  std::size_t recheck = 0, sure = 0, overlapping = 0;
};

/// Makes candidates of pairs (a < b), held if they overlap. Those whose cores overlap go to `sure`, the others to
/// `recheck`; pairs that overlap go to `overlapping` as well. Each array has room for all. Without cores none is sure.
CandidateCounts make_candidates(const Aabb* boxes, const Aabb* cores, const Pair* pairs, std::size_t count,
                                std::uint64_t* recheck, std::uint64_t* sure, Pair* overlapping);
CandidateCounts make_candidates(const Aabb64* boxes, const Aabb64* cores, const Pair* pairs, std::size_t count,
                                std::uint64_t* recheck, std::uint64_t* sure, Pair* overlapping);

/// Writes the indices of the `count` fat boxes that overlap `fat_box` to `overlapping`, which has room for all. Returns
/// their number.
std::size_t find_overlapping(const Aabb* fat_boxes, std::size_t count, const Aabb& fat_box, std::uint32_t* overlapping);
std::size_t find_overlapping(const Aabb64* fat_boxes, std::size_t count, const Aabb64& fat_box,
                             std::uint32_t* overlapping);

/// Writes the indices of the `count` boxes that are not between core and fat box to `outside`, which has room for all.
/// Returns their number. `cores` may be null: then a box need only be inside its fat box. `drift` is null or points to
/// three numbers between two zeros: then a box must be strictly between core and fat box, both moved by it. An infinite
/// bound counts as strictly beyond all.
std::size_t find_outside(const Aabb* fat_boxes, const Aabb* cores, const Aabb* boxes, std::size_t count,
                         const float* drift, std::uint32_t* outside);
std::size_t find_outside(const Aabb64* fat_boxes, const Aabb64* cores, const Aabb64* boxes, std::size_t count,
                         const double* drift, std::uint32_t* outside);

}  // namespace boxstream::detail
