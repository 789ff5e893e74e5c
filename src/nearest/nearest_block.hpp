// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "bvh/bvh_block.hpp"

namespace boxstream::detail {

/// Bit i: of the boxes in `count` blocks, 8 at most, number i may be within `reach` of `box`, squared, and `squared[i]`
/// is about how far off.
std::uint64_t lanes_near(const BoxBlock<float>* blocks, std::size_t count, const Aabb& box, float reach,
                         float* squared);
std::uint64_t lanes_near(const BoxBlock<double>* blocks, std::size_t count, const Aabb64& box, double reach,
                         double* squared);

/// Bit 8 i + j: lane i of `a` and lane j of `b` may be within `reach` of each other, squared, and `squared[8 i + j]` is
/// about how far off.
std::uint64_t lanes_near(const BoxBlock<float>& a, const BoxBlock<float>& b, const Aabb& bounds_of_b, float reach,
                         float* squared);
std::uint64_t lanes_near(const BoxBlock<double>& a, const BoxBlock<double>& b, const Aabb64& bounds_of_b, double reach,
                         double* squared);

/// The same within one block, each pair once: i < j. From lane `first` on, which becomes the first lane that is left:
/// all are done if the reach is finite; else not those after the first one with a pair that touches, as that may be
/// enough.
std::uint64_t lanes_near_each_other(const BoxBlock<float>& block, float reach, unsigned& first, float* squared);
std::uint64_t lanes_near_each_other(const BoxBlock<double>& block, double reach, unsigned& first, double* squared);

}  // namespace boxstream::detail
