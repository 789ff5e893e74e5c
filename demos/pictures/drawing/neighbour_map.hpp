// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "poster.hpp"

namespace boxstream::picture {

/// Disks or balls, and which of them are within a distance of each other.
struct NeighbourMap {
  struct Place {
    double x, y, z, radius;  ///< finite
  };
  std::string title, subtitle;
  std::vector<Place> places;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  double distance;
};

/// A map of all places from above, and to its right the surroundings of the one with most neighbours, to scale: half of
/// the distance around each. Throws std::runtime_error.
void write_neighbour_map(const NeighbourMap& map, std::ostream& out, PictureFormat format);

}  // namespace boxstream::picture
