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

/// A method of finding the pairs of a frame, as an experiment lists it.
struct Method {
  std::string series;
  std::string setting;    ///< of its own knob, if it has one
  double x = NAN;         ///< the same as a number
  std::size_t most = 0;   ///< up to this number of boxes; 0: any number
  bool superset = false;  ///< it returns extra pairs, as documented
  std::string known_difference;
  std::unique_ptr<bench::Peer> peer;
};

/// Reads a list of methods: a name, or {"way": NAME, "most": N, "room": SHARE}. Names: "detector" and "world" (ours,
/// each frame from nothing, and kept from frame to frame), "rooms" and "rooms-tested" (FatBoxes: its candidates, and
/// those of them that touch), and the names of peers (bench). Throws std::invalid_argument.
std::vector<Method> read_methods(const nlohmann::json& list);

}  // namespace boxstream::report
