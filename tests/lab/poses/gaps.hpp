// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "hard_pose.hpp"

/// Pairs of boxes and hulls that just touch, or are a hair apart or inside each other.
namespace boxstream::poses {

constexpr std::array<double, 15> gaps = {-1e-6, -1e-8, -1e-10, -1e-12, -1e-14, -1e-15, -1e-16, 0,
                                         1e-16, 1e-15, 1e-14,  1e-12,  1e-10,  1e-8,   1e-6};

enum class Family {
  stacked_boxes,  ///< face on face, turned together
  boxes,          ///< whatever is closest: corners, edges, faces
  hulls           ///< the same, of 4 to 12 corners
};
constexpr int families = 3;

/// Sizes around 1, the same for the same seed. The gap is what the pose aims at; its truth, which rounding moves by
/// some 1e-16, is what it is.
HardPose gap_pose(Family family, double gap, unsigned seed);

/// All of them with a number of seeds each, for counting.
constexpr int gap_seeds = 20;
constexpr int gap_poses = families * static_cast<int>(gaps.size()) * gap_seeds;
HardPose gap_pose(int index);
/// Of a pose that is counted.
double gap_of(int index);

}  // namespace boxstream::poses
