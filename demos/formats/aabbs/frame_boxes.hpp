// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/out_of_core.hpp>
#include <cstdint>
#include <istream>
#include <vector>

#include "formats/aabbs/format.hpp"

namespace boxstream::aabbs {

/// The boxes of one frame, a block at a time, for searches of frames that are larger than memory.
class FrameBoxes final : public BoxReader {
 public:
  /// Borrows `in`, which has to be a file with this header that a Reader has accepted. `frame` counts from 0.
  FrameBoxes(std::istream& in, const Header& header, std::uint64_t frame);

  void rewind() override;
  /// Throws AabbsError if the file has become shorter.
  Span<const Aabb> read() override;

  /// Boxes read since `rewind`.
  std::uint64_t position() const { return next_; }
  /// How often all have been begun.
  std::uint64_t passes() const { return passes_; }

 private:
  std::istream& in_;
  std::uint64_t objects_, frame_, next_ = 0, passes_ = 0;
  std::vector<unsigned char> bytes_;
  std::vector<Aabb> boxes_;
};

/// Frames of the file: steps, or one more. 0 if `in` cannot be read twice.
std::uint64_t frames_in(std::istream& in, const Header& header);

}  // namespace boxstream::aabbs
