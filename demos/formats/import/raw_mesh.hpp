// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace boxstream::imports {

/// Triangles as a file has them: vertices may be there many times, coordinates may be anything.
struct RawMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Of each triangle, which of the file's faces it is part of, counted from 0; ascending.
  std::vector<std::uint32_t> faces;
};

}  // namespace boxstream::imports
