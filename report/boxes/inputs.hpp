// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

namespace boxstream::report {

/// Boxes from frame to frame, and what is known of them.
struct Frames {
  std::vector<std::vector<Aabb>> boxes;  ///< of each frame; at least two of them
  std::vector<std::uint32_t> moved;      ///< those that the application sets in each frame
  std::vector<std::vector<Pair>> pairs;  ///< that there are, sorted; of each frame
  double in_contact = 0;                 ///< of these pairs the share whose shapes touch; NaN where boxes have none
};

/// How a scene with many bodies is made into frames.
struct Baking {
  std::string scene;
  std::size_t n = 0;        ///< dynamic bodies, about
  std::size_t warm_up = 0;  ///< steps before the first frame
  std::size_t frames = 2;
};

/// The boxes of the dynamic bodies of a scene, which Bullet moves, in consecutive steps: all are set in each frame, as
/// Bullet does.
Frames bake(const Baking& baking);

/// A batch (batches.hpp) of which `share` moves as in Brownian motion, at most `step` of the own side on each axis.
Frames brownian(const std::string& batch, std::size_t n, double share, double step, std::size_t frames);

}  // namespace boxstream::report
