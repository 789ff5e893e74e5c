// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/aabbs/format.hpp"
#include "formats/record/replay.hpp"

namespace boxstream::tool {

/// A file of boxes, run on one broad-phase or on two.
struct AabbsRun {
  struct Frame {
    std::uint64_t pairs = 0;  // whose boxes overlap
    std::vector<double> milliseconds;
  };

  std::string file;
  aabbs::Header header;
  std::vector<std::string> broadphases;
  std::vector<Frame> frames;
  std::uint64_t invalid_boxes = 0;  // a NaN, or min > max
  std::optional<bool> pairs_equal;  // of a comparison
  std::string first_difference;
};

/// For reading: a few lines.
std::string aabbs_text(const AabbsRun& run);
/// For programs, as one JSON document ending in a newline; demos/boxstream/README.md lists its fields.
std::string aabbs_json(const AabbsRun& run);

/// A replay, and what it was of.
struct ReplayRun {
  std::string file;
  record::Header header;
  record::Census census;
  std::vector<std::string> broadphases;
  record::ReplayResult result;
};

/// For reading: a few lines.
std::string replay_text(const ReplayRun& run);
/// For programs, as one JSON document ending in a newline; demos/boxstream/README.md lists its fields.
std::string replay_json(const ReplayRun& run);

}  // namespace boxstream::tool
