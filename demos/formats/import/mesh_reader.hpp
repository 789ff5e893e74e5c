// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/import/mesh.hpp"

namespace boxstream::imports {

/// Triangles as a file has them: vertices may be there many times, coordinates may be anything.
struct RawMesh {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Through assimp; where that was not there at build time, this says so. Throws std::runtime_error with the reason.
RawMesh read_raw_mesh(const std::string& path, UpAxis up);

}  // namespace boxstream::imports
