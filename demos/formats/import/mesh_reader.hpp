// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "formats/import/mesh.hpp"
#include "formats/import/mesh_files/mesh_files.hpp"

namespace boxstream::imports {

/// What is not as it is in the file after it has been read, in a line; empty if all is. Of Collada, which is read
/// through assimp, which has floats, how many coordinates are none (glTF has floats of its own); of binary STL,
/// triangles that it does not count.
std::string surface_note(const std::string& path);

/// That of the text of a Collada file.
std::string rounding_in_collada(std::string_view text);

/// The faces of a file: by readers of doubles (mesh_files), and of what these do not read, Collada and glTF, through
/// assimp, which has floats; where that was not there at build time, this says so. Throws std::runtime_error with the
/// reason.
RawMesh read_raw_mesh(const std::string& path, UpAxis up);

/// Through assimp.
RawMesh read_by_assimp(const std::string& path, UpAxis up);

}  // namespace boxstream::imports
