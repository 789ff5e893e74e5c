// SPDX-License-Identifier: MIT
#pragma once

#include <cstring>
#include <sstream>
#include <string>

#include "solids.hpp"

/// The same mesh in other formats, as their specifications have them.
namespace boxstream::import_test {

template <class T>
void put(std::string& bytes, T value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
  bytes.append(raw, sizeof value);
}

inline std::string as_ascii_stl(const TriangleMesh& mesh) {
  std::ostringstream text;
  text << "solid thing\n";
  for (const auto& t : mesh.triangles) {
    text << "facet normal 0 0 0\n outer loop\n";
    for (const unsigned corner : t) {
      const Vec3& v = mesh.vertices[corner];
      text << "  vertex " << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
    }
    text << " endloop\nendfacet\n";
  }
  text << "endsolid thing\n";
  return text.str();
}

inline std::string as_binary_stl(const TriangleMesh& mesh) {
  std::string bytes(80, 'x');
  put(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) put(bytes, 0.0f);
    for (const unsigned corner : t)
      for (const double x : mesh.vertices[corner]) put(bytes, static_cast<float>(x));
    put(bytes, std::uint16_t{0});
  }
  return bytes;
}

inline std::string as_ply(const TriangleMesh& mesh) {
  std::ostringstream text;
  text << "ply\nformat ascii 1.0\nelement vertex " << mesh.vertices.size()
       << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << mesh.triangles.size()
       << "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const Vec3& v : mesh.vertices) text << v[0] << ' ' << v[1] << ' ' << v[2] << '\n';
  for (const auto& t : mesh.triangles) text << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  return text.str();
}

/// Positions, then indices.
inline std::string gltf_buffer(const TriangleMesh& mesh) {
  std::string bytes;
  for (const Vec3& v : mesh.vertices)
    for (const double x : v) put(bytes, static_cast<float>(x));
  for (const auto& t : mesh.triangles)
    for (const unsigned corner : t) put(bytes, corner);
  return bytes;
}

/// `uri` of the buffer may be empty, for .glb. The one node moves by (10, 0, 0).
inline std::string gltf_json(const TriangleMesh& mesh, const std::string& uri) {
  const std::size_t positions = 12 * mesh.vertices.size(), indices = 12 * mesh.triangles.size();
  std::ostringstream text;
  text << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],)"
       << R"("nodes":[{"mesh":0,"translation":[10,0,0]}],)"
       << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
       << R"("buffers":[{"byteLength":)" << positions + indices;
  if (!uri.empty()) text << R"(,"uri":")" << uri << '"';
  text << R"(}],"bufferViews":[{"buffer":0,"byteLength":)" << positions << R"(},{"buffer":0,"byteOffset":)" << positions
       << R"(,"byteLength":)" << indices << R"(}],"accessors":[{"bufferView":0,"componentType":5126,"count":)"
       << mesh.vertices.size() << R"(,"type":"VEC3","min":[0,0,0],"max":[1,2,3]},)"
       << R"({"bufferView":1,"componentType":5125,"count":)" << 3 * mesh.triangles.size() << R"(,"type":"SCALAR"}]})";
  return text.str();
}

inline std::string as_glb(const TriangleMesh& mesh) {
  std::string json = gltf_json(mesh, ""), buffer = gltf_buffer(mesh), bytes = "glTF";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
  put(bytes, std::uint32_t{2});
  put(bytes, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + buffer.size()));
  put(bytes, static_cast<std::uint32_t>(json.size()));
  bytes += "JSON" + json;
  put(bytes, static_cast<std::uint32_t>(buffer.size()));
  bytes += std::string("BIN\0", 4) + buffer;
  return bytes;
}

}  // namespace boxstream::import_test
