// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <istream>
#include <vector>

#include "formats/aabbs/format.hpp"

namespace boxstream::aabbs {

/// Reads a file frame by frame. Takes memory in proportion to what it has read, never to what the header claims.
///
/// A file with as many frames as steps, without the one at the start, is read too. Nothing is said of the boxes: they
/// may be NaN or inverted.
class Reader {
 public:
  /// Borrows `in`. Reads the header, and compares it with the size of the file if `in` can tell. Throws AabbsError.
  explicit Reader(std::istream& in);

  const Header& header() const { return header_; }
  /// Replaces `boxes` by those of the next frame; false after the last one. Throws AabbsError.
  bool next(std::vector<Aabb>& boxes);
  std::uint64_t frames_read() const { return frames_; }

 private:
  void check_size();

  std::istream& in_;
  Header header_;
  std::uint64_t frames_ = 0;
};

}  // namespace boxstream::aabbs
