// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/out_of_core.hpp>
#include <cstdint>
#include <istream>
#include <ostream>
#include <string>
#include <vector>

#include "boxstream/shared/print.hpp"
#include "formats/aabbs/format.hpp"

namespace boxstream::tool {

/// A file of boxes whose frames need not fit in memory.
struct LargeFrames {
  struct Frame {
    OutOfCoreStats stats;
    double seconds = 0;  // on the wall
  };

  std::string file;
  aabbs::Header header;
  std::uint64_t memory = 0;  // bytes
  std::vector<Frame> frames;
};

/// Finds the pairs of each frame. Writes each to `pairs`, if not null, as a line: frame, a, b. Throws
/// aabbs::AabbsError; BadInput if `in` cannot be read twice.
LargeFrames find_in_large_frames(std::istream& in, const std::string& file, const OutOfCoreOptions& options,
                                 std::ostream* pairs, StatusLine& status);

/// As aabbs_text and aabbs_json.
std::string large_frames_text(const LargeFrames& frames);
std::string large_frames_json(const LargeFrames& frames);

}  // namespace boxstream::tool
