// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "boxstream/pairs/number_rows.hpp"

namespace boxstream::tool {

/// What `boxstream near` found, and in what.
struct NearRun {
  std::string source;  ///< a file, or the traffic with its seed
  std::string what;    ///< "objects", "aircraft", "ships"
  std::string engine;
  Balls balls;
  double distance;
  std::vector<Pair> pairs{};  ///< sorted, if they were asked for
};

/// "a,b,gap" and a row for each pair. The gap between two balls is a double's, and below 0 where they overlap.
std::string near_csv(const NearRun& run);
std::string near_json(const NearRun& run);
/// The objects, as `read_balls` reads them.
std::string balls_csv(const Balls& balls);

}  // namespace boxstream::tool
