// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "formats/import/mesh_reader.hpp"

namespace boxstream::imports {

/// The triangles of a .ply file that has strips of them (an element "tristrips": lists of vertices, every three in a
/// row a triangle, every second one turned over; a number below 0 ends a strip), as scanners write. None for a file
/// without strips, which other readers read. Lists of an element "face" are convex polygons.
///
/// Throws std::runtime_error with the reason: cut off, a list longer than the file, a vertex that is not there.
std::optional<RawMesh> read_ply_strips(const std::string& path);

}  // namespace boxstream::imports
