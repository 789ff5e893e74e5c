// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "pictures/viewer/snapshot.hpp"

namespace boxstream::view {

/// Frames of the viewer, in blocks that can be read alone. All numbers are whole: lengths count a fixed unit,
/// components of rotations count 1/32767. A frame is
///   places     3 x 32 bits for each object, then each node
///   rotations  4 x 24 bits for each object
///   corners    6 x 32 bits for each object: min, then max of its box, as seen from its place
///   islands    32 bits for each object
///   moods      8 bits for each object
///   pairs      ended, then begun since the frame before: each a count and that many pairs
/// Numbers are coded as what is left when they are foretold from the one or two frames before in the block (nothing in
/// its first frame, the former value in the second, afterwards going on in a straight line; for islands and moods
/// always the former value), with the sign in the lowest bit; each of the five arrays is then laid out by significance:
/// all lowest bytes, then all second ones, and so on. The high ones are nearly all zero, which compresses to nothing.
/// Pairs are sorted and coded as LEB128 numbers: a since the pair before, and b since a or, if a is the same, since the
/// b before.
class FrameEncoder {
 public:
  static constexpr std::size_t frames_in_block = 16;
  static constexpr float rotation_unit = 1.0F / 32767;

  /// `unit` of lengths, in those of the world. Lengths beyond what 32 bits hold are cut off at 2^30 units; those that
  /// are not numbers are `not_a_number`.
  explicit FrameEncoder(float unit) : unit_(unit) {}
  static constexpr std::int32_t not_a_number = INT32_MIN;

  void add(const Snapshot& snapshot);
  /// True when a block is full: take it before the next frame is added.
  bool is_full() const { return frames_ == frames_in_block; }
  bool is_empty() const { return frames_ == 0; }
  /// The block so far; begins the next one.
  std::string take_block();

 private:
  /// An array through time.
  class Series {
   public:
    /// Appends the coded array, `bytes` for each number.
    void code(const std::vector<std::int32_t>& values, int bytes, bool straight, std::string& out);
    void restart() { age_ = 0; }

   private:
    std::vector<std::int32_t> former_, before_former_;
    std::vector<std::uint32_t> coded_;
    int age_ = 0;
  };

  std::int32_t fixed(float length) const;
  void code_pairs(const std::vector<Pair>& pairs);

  float unit_;
  std::size_t frames_ = 0;
  std::string block_;
  Series places_, rotations_, corners_, islands_, moods_;
  std::vector<std::int32_t> numbers_;
  std::vector<Pair> former_pairs_;
};

/// What is left out when a page would become too large is whole frames: the number of bytes to expect for one, in the
/// page, of a world that moves all over. Measured with scenes/storm.json, every third step, and cloth.json.
std::size_t expected_frame_size(std::size_t objects, std::size_t nodes);

}  // namespace boxstream::view
