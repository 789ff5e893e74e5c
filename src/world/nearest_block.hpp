// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "index/bvh_block.hpp"

namespace boxstream::detail {

/// Lanes of `block` whose bounds may be within `reach` of `box`, squared, and about how far off they are, squared.
unsigned lanes_near(const BoxBlock<float>& block, const Aabb& box, float reach, float* squared);
unsigned lanes_near(const BoxBlock<double>& block, const Aabb64& box, double reach, double* squared);

/// Bit 8 i + j: lane i of `a` and lane j of `b` may be within `reach` of each other, squared, and `squared[8 i + j]` is
/// about how far off.
std::uint64_t lanes_near(const BoxBlock<float>& a, const BoxBlock<float>& b, const Aabb& bounds_of_b, float reach,
                         float* squared);
std::uint64_t lanes_near(const BoxBlock<double>& a, const BoxBlock<double>& b, const Aabb64& bounds_of_b, double reach,
                         double* squared);

}  // namespace boxstream::detail
