// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/span.hpp>
#include <cstdint>
#include <ostream>
#include <vector>

#include "formats/aabbs/format.hpp"

namespace boxstream::aabbs {

/// Writes a file frame by frame: the start, then one after each step.
class Writer {
 public:
  /// Borrows `out`, and writes the header; longer texts are cut off. Throws std::invalid_argument unless counts are
  /// from 1 to 2^31 - 1 and the world is a valid box.
  Writer(std::ostream& out, Header header);

  /// Throws std::invalid_argument unless there are as many boxes as objects, and frames to come.
  void frame(Span<const Aabb> boxes);

  /// Throws std::logic_error if frames are missing, std::runtime_error if something could not be written.
  void finish();

 private:
  std::ostream& out_;
  Header header_;
  std::uint64_t frames_ = 0;
  std::vector<char> bytes_;
};

}  // namespace boxstream::aabbs
