// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

class btDynamicsWorld;

namespace boxstream::report {

/// Boxes from frame to frame, and their pairs.
struct Frames {
  std::vector<std::vector<Aabb>> boxes;  ///< of each frame; at least two of them
  std::vector<std::uint32_t> moved;      ///< those that the application sets in each frame
  std::vector<std::vector<Pair>> pairs;  ///< expected ones of each frame, sorted
  double in_contact = 0;                 ///< of these pairs the share whose shapes touch; NaN where boxes have none
};

/// Pairs of objects in contact, with a distance of at most 0; `dynamic_only`: of two dynamic bodies.
std::size_t touching_pairs(btDynamicsWorld& world, bool dynamic_only);

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
