// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "formats/scene_model/values.hpp"

namespace boxstream::imports {

struct Solid {
  double volume = 0;  // negative if the triangles are clockwise seen from outside
  scenes::Vec3 centroid{};
};

/// Of what closed triangles enclose.
Solid measure(const std::vector<scenes::Vec3>& vertices, const std::vector<std::array<std::uint32_t, 3>>& triangles);

/// Does every edge belong to as many triangles in one direction as in the other?
bool is_closed(const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace boxstream::imports
