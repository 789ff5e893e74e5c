// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <boxstream/near.hpp>

/// Aircraft and ships at one moment, for safety distances: a pure function of (name, n, seed), the same bits on every
/// platform. Made up, but busy where real traffic is: near airports and ports, and along the routes between them.
namespace boxstream::batches {

struct Traffic {
  std::vector<Ball64> objects;  ///< in nautical miles, to a thousandth; every 2000 have a region of their own
  int dimensions;
  double safety_distance;  ///< what is usual to keep
  std::string what;        ///< "aircraft", "ships"
};

/// "air": points in the space above a region. Airliners keep 5 miles apart, or 1000 ft in height: heights are stretched
/// so that 1000 ft are 5 miles here too, and the ball of 5 miles lies within what is to be kept free. They climb,
/// cruise at levels that are even thousands of feet one way and odd ones the other, and descend. "sea": disks around
/// ships of 15 m to 400 m in the plane z = 0, at anchor, in lanes that keep to the right, and fishing anywhere. They
/// keep half a mile apart. Throws std::invalid_argument for another name.
Traffic make_traffic(std::string_view name, std::size_t n, std::uint64_t seed);

}  // namespace boxstream::batches
