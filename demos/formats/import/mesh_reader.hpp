// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "formats/import/mesh.hpp"
#include "formats/import/raw_mesh.hpp"

namespace boxstream::imports {

/// The faces of a file: by readers of doubles (mesh_files), and of what these do not read, Collada and glTF, through
/// assimp, which has floats; where that was not there at build time, this says so. Throws std::runtime_error with the
/// reason.
RawMesh read_raw_mesh(const std::string& path, UpAxis up);

/// Through assimp.
RawMesh read_by_assimp(const std::string& path, UpAxis up);

}  // namespace boxstream::imports
