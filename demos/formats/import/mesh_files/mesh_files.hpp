// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace boxstream::imports {

/// Triangles as a file has them: vertices may be there many times, coordinates may be anything.
struct RawMesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Of each triangle, which of the file's faces it is part of, counted from 0; ascending.
  std::vector<std::uint32_t> faces;
};

/// The faces of a file of that kind, given its bytes. Coordinates are the doubles that are nearest to the numbers in
/// the file. Polygons become triangles (polygons.hpp); colours, normals, materials, lines and points are left out. All
/// corners of triangles are vertices.
///
/// Throws std::runtime_error with the reason: cut off, no number where one should be, a vertex that is not there.
RawMesh read_obj(std::string_view bytes);
/// ASCII and binary of both orders. Strips of triangles (an element "tristrips": every three vertices in a row a
/// triangle, every second one turned over; a number below 0 ends a strip), as scanners write them, are faces each.
RawMesh read_ply(std::string_view bytes);
/// ASCII and binary.
RawMesh read_stl(std::string_view bytes);
/// What a binary file has behind the triangles that it counts, or that a text ends without "endsolid"; else empty.
std::string unread_in_stl(std::string_view bytes);
/// With and without colours and normals (OFF, COFF, NOFF, CNOFF, STOFF); of three dimensions, in ASCII.
RawMesh read_off(std::string_view bytes);

}  // namespace boxstream::imports
