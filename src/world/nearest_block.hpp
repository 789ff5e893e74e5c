// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "index/bvh_block.hpp"
#include "world/nearest_distance.hpp"

namespace boxstream::detail {

/// Lanes of `block` that may contain boxes within the window of `box`, and about how far off they are, squared.
unsigned lanes_near(const BoxBlock<float>& block, const Aabb& box, const NearWindow<float>& window, float* squared);
unsigned lanes_near(const BoxBlock<double>& block, const Aabb64& box, const NearWindow<double>& window,
                    double* squared);

/// The same for lanes that are boxes themselves.
unsigned leaf_lanes_near(const BoxBlock<float>& block, const Aabb& box, const NearWindow<float>& window,
                         float* squared);
unsigned leaf_lanes_near(const BoxBlock<double>& block, const Aabb64& box, const NearWindow<double>& window,
                         double* squared);

/// Bit 8 i + j: the boxes in lane i of `a` and lane j of `b` may be within the window of each other, and
/// `squared[8 i + j]` is about how far off.
std::uint64_t leaf_lanes_near(const BoxBlock<float>& a, const BoxBlock<float>& b, const NearWindow<float>& window,
                              float* squared);
std::uint64_t leaf_lanes_near(const BoxBlock<double>& a, const BoxBlock<double>& b, const NearWindow<double>& window,
                              double* squared);

}  // namespace boxstream::detail
