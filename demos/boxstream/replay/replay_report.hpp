// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "formats/record/replay.hpp"

namespace boxstream::tool {

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
