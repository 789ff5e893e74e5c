// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pictures/viewer/model.hpp"
#include "pictures/viewer/pair_code.hpp"
#include "pictures/viewer/series.hpp"
#include "pictures/viewer/snapshot.hpp"

namespace boxstream::view {

/// Which objects can be seen to turn: all but those that are one ball. Nothing keeps the rotations of the others.
std::vector<std::uint32_t> turning(const Model& model);

/// Frames of the viewer, in blocks that can be read alone. A frame is these series, one after the other, then pairs,
/// touches and contacts:
///   places     3 for each object, wheel and node, in units; goes on
///   rotations  4 for each of `turning`, in `rotation_unit`; goes on
///   boxes      6 for each object and wheel, in two units: the middle, as seen from its place in the frame before, then
///              the extents; no number if there is no box; goes on
///   islands    1 for each object and wheel
///   moods      the same
/// In the first frame of a block that place is the one of the frame itself. So every place and node is shown to
/// half a unit, each face of a box to two units, each component of a rotation to half a `rotation_unit`;
/// rounding to sixteenths first adds a 32nd of a quantum.
class FrameEncoder {
 public:
  static constexpr std::size_t frames_in_block = 64;
  static constexpr float rotation_unit = 1.0F / 1024;

  /// `unit` of lengths, in those of the world. Lengths beyond 2^25 of it are cut off there.
  FrameEncoder(float unit, const Model& model);

  void add(const Snapshot& snapshot);
  /// True when a block is full: take it before the next frame is added.
  bool is_full() const { return frames_ == frames_in_block; }
  bool is_empty() const { return frames_ == 0; }
  /// The block so far; begins the next one.
  std::string take_block();

 private:
  std::int32_t fixed(double value, double quantum) const;
  void code_places(const Snapshot& snapshot);
  void code_rotations(const Snapshot& snapshot);
  void code_boxes(const Snapshot& snapshot);

  float unit_;
  std::vector<std::uint32_t> turning_;
  std::size_t frames_ = 0;
  std::string block_;
  Series places_{true}, rotations_{true}, boxes_{true}, islands_{false}, moods_{false};
  PairCode pairs_;
  std::vector<std::int32_t> numbers_, former_places_;
};

/// What is left out when a page would become too large is whole frames: the number of bytes to expect for one, in the
/// page, of a world that moves all over. Measured with scenes/storm.json, which takes 3 for an object, pile.json, 7
/// while it lands, and cloth.json.
std::size_t expected_frame_size(std::size_t objects, std::size_t nodes);

}  // namespace boxstream::view
