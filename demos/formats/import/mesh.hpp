// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "formats/import/mesh_files/mesh_files.hpp"
#include "formats/scene_model/values.hpp"

namespace boxstream::imports {

/// Triangles are counter-clockwise seen from outside; vertices at the same place are one.
struct TriangleMesh {
  std::vector<scenes::Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Of a mesh from a file: which of the file's faces, from 0 on, each triangle is part of. Of .dae, .gltf and .glb,
  /// faces are triangles, in order of material.
  std::vector<std::uint32_t> faces = {};
};

/// Whether `path` is named like a mesh that read_mesh reads: .obj, .stl, .ply, .off, .dae, .gltf, .glb.
bool is_mesh_file(const std::string& path);

/// All triangles of a file, in its coordinates times `scale`, which are doubles but for .dae, .gltf and .glb; a
/// mirroring scale turns them over, so that outside stays outside. Nodes of a glTF scene are where its transforms put
/// them. Triangles without area, points, lines, materials and everything else are left out; so are vertices of
/// triangles that no reader here supports, with a message: left_over_vertices() counts them, and a file most of whose
/// vertices are left over is refused.
///
/// Throws scenes::SceneError "PATH: reason": not readable, no triangles, most vertices left over, more than a million
/// vertices or triangles, a coordinate that is not finite or beyond 100 km; or when built without assimp.
TriangleMesh read_mesh(const std::string& path, const scenes::Vec3& scale = {1, 1, 1});

/// The surface that a file has, to be looked into rather than simulated: triangles without area stay, and coordinates
/// may be up to 1e30. There may be 20 million vertices, and triangles, but no more than 512 MiB of both: 24 bytes a
/// vertex and 16 a triangle, which is some 19 million triangles of a closed surface. Throws scenes::SceneError as
/// read_mesh() does.
TriangleMesh read_surface(const std::string& path);

/// Vertices of the mesh that belong to no triangle.
std::size_t left_over_vertices(const TriangleMesh& mesh);

/// Collada says which axis is up, and its readers turn it to y. Robots have meshes with axes of their own, whatever is
/// said there.
enum class UpAxis { as_the_file_says, left_alone };

/// As read_mesh(), without the guard of a child process, for use inside of one.
TriangleMesh read_mesh_unguarded(const std::string& path, const scenes::Vec3& scale, UpAxis up);

/// What a file has as read_mesh() gives it; `path` is for messages.
TriangleMesh welded(const std::string& path, const RawMesh& raw, const scenes::Vec3& scale);

}  // namespace boxstream::imports
