// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pictures/viewer/kept.hpp"
#include "pictures/viewer/model.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::view {

/// What each object that is kept is called: by the scene's name for it, or for its shape.
std::vector<std::string> names_of(const scenes::Simulation& simulation, const Kept& kept);

/// A joint, as it is drawn: its pivot in the coordinates of both bodies.
struct Link {
  std::int32_t a = 0;
  std::int32_t b = 0;  ///< -1: the world
  Point pivot_in_a{}, pivot_in_b{};
};

/// The joints of objects that are kept, by their places.
std::vector<Link> links_of(const scenes::Simulation& simulation, const Kept& kept);

}  // namespace boxstream::view
