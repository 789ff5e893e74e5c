// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "peers/peer.hpp"

namespace boxstream::report {

/// A way from the boxes of a frame to pairs, as an experiment lists it.
struct Way {
  std::string series;
  std::string setting;    ///< of its own knob, if it has one
  double x = NAN;         ///< the same as a number
  std::size_t most = 0;   ///< boxes that it is given at most; 0: any number
  bool superset = false;  ///< it hands over extra pairs, as it says it does
  std::string known_difference;
  std::unique_ptr<bench::Peer> peer;
};

/// Reads a list of ways: a name, or {"way": NAME, "most": N, "room": SHARE}. Names: "detector" and "world" (ours, each
/// frame from nothing, and kept from frame to frame), "rooms" and "rooms-tested" (FatBoxes: its candidates, and those
/// of them that touch), and the names of peers (bench). Throws std::invalid_argument.
std::vector<Way> read_ways(const nlohmann::json& list);

}  // namespace boxstream::report
