// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "bvh_block.hpp"
#include "world_nearest_distance.hpp"

namespace boxstream::detail {

/// Lanes of `block` that may contain something within the window of `box`, and about how far off they are, squared.
unsigned lanes_near(const BoxBlock<float>& block, const Aabb& box, const NearWindow<float>& window, float* squared);
unsigned lanes_near(const BoxBlock<double>& block, const Aabb64& box, const NearWindow<double>& window,
                    double* squared);

/// Bit 8 i + j: lane i of `a` and lane j of `b` may be nearer to each other than the window reaches.
std::uint64_t lanes_near(const BoxBlock<float>& a, const BoxBlock<float>& b, float reach);
std::uint64_t lanes_near(const BoxBlock<double>& a, const BoxBlock<double>& b, double reach);

}  // namespace boxstream::detail
