// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "inputs/random.hpp"

namespace boxstream::bench {

/// How boxes move from frame to frame.
enum class Motion {
  brown,     ///< all: on each axis up to a tenth of the own side, either way
  static5,   ///< the same, but only a fixed twentieth of the boxes
  one,       ///< the same, but only one box, always the same
  fall,      ///< all down the y axis: each with a start speed of its own, and one acceleration for all
  teleport,  ///< all: each takes the place of another, so that crowds stay as dense as they were
  asleep,    ///< none; all are set again to what they are
  tremble,   ///< all: up to a thousandth of the own side about where they started
};

struct MotionName {
  std::string_view name;
  Motion motion;
  std::string_view description;
};

Span<const MotionName> motions();

/// Motion::brown with other numbers.
struct Brownian {
  double share = 1;   ///< of the boxes, always the same ones, that move
  double step = 0.1;  ///< of the own side, at most, on each axis and in each frame
};

/// Boxes in motion: a pure function of the boxes, the motion, the seed and the number of calls.
class MovingBoxes {
 public:
  MovingBoxes(std::vector<Aabb> boxes, Motion motion, std::uint64_t seed);
  MovingBoxes(std::vector<Aabb> boxes, Brownian motion, std::uint64_t seed);

  Span<const Aabb> boxes() const { return boxes_; }

  /// Those that the application sets in each frame, changed or not; in order.
  Span<const std::uint32_t> moved() const { return moved_; }

  void next_frame();

 private:
  void place(std::size_t i, const double (&offset)[3]);
  void step(std::uint32_t i);
  void tremble();
  void teleport();
  void fall();

  std::vector<Aabb> start_, boxes_;
  Motion motion_;
  double step_;  // of the own side
  batches::Random random_;
  std::vector<std::uint32_t> moved_, places_;
  std::vector<double> offsets_;  // from the start, three a box
  std::vector<double> speeds_;   // down, one a box
  double mean_side_ = 0;
};

/// The boxes scaled, exactly, by the power of two that brings their mean side closest to 1: some peers have margins in
/// units of their own.
std::vector<Aabb> scaled_to_unit_sides(std::vector<Aabb> boxes);

}  // namespace boxstream::bench
