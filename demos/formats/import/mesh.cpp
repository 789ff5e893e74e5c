// SPDX-License-Identifier: MIT
#include "formats/import/mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "base/read_file.hpp"
#include "formats/import/file_kind.hpp"
#include "formats/import/geometry.hpp"
#include "formats/import/guarded.hpp"
#include "formats/import/mesh_files/mesh_files.hpp"
#include "formats/import/mesh_reader.hpp"

namespace boxstream::imports {
namespace {

struct Limits {
  std::size_t most;  ///< vertices, and triangles
  const char* too_many;
  double max_length;
  const char* too_far;
  double least_doubled_area_squared;  ///< triangles up to this are left out
};

/// Scenes refuse triangles of less area too; in m^4.
constexpr Limits of_scenes{1'000'000, "more than a million vertices or triangles", 1e5, "a coordinate beyond 100 km",
                           1e-18};
constexpr Limits of_surfaces{20'000'000, "more than 20 million vertices or triangles", 1e30, "a coordinate beyond 1e30",
                             -1};

template <class T>
void put(std::string& bytes, const std::vector<T>& items) {
  const std::uint64_t count = items.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(T));
}

template <class T>
bool take(const std::string& bytes, std::size_t& at, std::size_t most, std::vector<T>& items) {
  std::uint64_t count = 0;
  if (bytes.size() - at < sizeof count) return false;
  std::memcpy(&count, bytes.data() + at, sizeof count);
  at += sizeof count;
  if (count > most || bytes.size() - at < count * sizeof(T)) return false;
  items.resize(count);
  std::memcpy(items.data(), bytes.data() + at, count * sizeof(T));
  at += count * sizeof(T);
  return true;
}

/// What a crashing reader leaves behind must not pass for a mesh.
bool is_sound(const TriangleMesh& mesh) {
  const auto known = [&](std::uint32_t v) { return v < mesh.vertices.size(); };
  return !mesh.triangles.empty() && mesh.faces.size() == mesh.triangles.size() &&
         std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_finite) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(),
                     [&](const auto& t) { return known(t[0]) && known(t[1]) && known(t[2]); });
}

std::string no_triangles(const RawMesh& raw) {
  if (!raw.triangles.empty()) return "no triangles in it that have an area";
  if (raw.vertices.empty()) return "no triangles in it";
  return "no triangles in it, but " + std::to_string(raw.vertices.size()) + " vertices: a cloud of points?";
}

TriangleMesh welded_within(const Limits& limits, const std::string& path, const RawMesh& raw, const Vec3& scale) {
  TriangleMesh mesh;
  std::map<Vec3, std::uint32_t> numbers;
  std::vector<std::uint32_t> number_of(raw.vertices.size());
  for (std::size_t i = 0; i < raw.vertices.size(); ++i) {
    Vec3 v{};
    for (std::size_t d = 0; d < 3; ++d) v[d] = static_cast<double>(raw.vertices[i][d]) * scale[d];
    const auto complain = [&](const std::string& what) {
      fail(path, "vertex " + std::to_string(i) + ", from 0 on: " + what);
    };
    if (!is_finite(v)) complain("a coordinate that is not a finite number");
    for (const double x : v)
      if (std::abs(x) > limits.max_length) complain(limits.too_far);
    const auto [place, added] = numbers.try_emplace(v, static_cast<std::uint32_t>(mesh.vertices.size()));
    if (added) mesh.vertices.push_back(v);
    number_of[i] = place->second;
  }
  const bool mirrored = scale[0] * scale[1] * scale[2] < 0;
  for (std::size_t i = 0; i < raw.triangles.size(); ++i) {
    const auto& corners = raw.triangles[i];
    std::array<std::uint32_t, 3> t{};
    for (std::size_t k = 0; k < 3; ++k) t[k] = number_of[corners[k]];
    if (mirrored) std::swap(t[1], t[2]);
    const Vec3& a = mesh.vertices[t[0]];
    const Vec3 n = cross(minus(mesh.vertices[t[1]], a), minus(mesh.vertices[t[2]], a));
    if (!(dot(n, n) > limits.least_doubled_area_squared)) continue;
    mesh.triangles.push_back(t);
    if (!raw.faces.empty()) mesh.faces.push_back(raw.faces[i]);
  }
  if (mesh.triangles.empty()) fail(path, no_triangles(raw));
  return mesh;
}

/// A format that a reader supports in part gives a mesh in part, without a message.
void check_is_whole(const std::string& path, const TriangleMesh& mesh) {
  const std::size_t all = mesh.vertices.size(), left_over = left_over_vertices(mesh);
  if (2 * left_over > all)
    fail(path, std::to_string(left_over) + " of " + std::to_string(all) +
                   " vertices belong to no triangle: its triangles are not all there, or in a form that is not known");
}

TriangleMesh read_within(const Limits& limits, const std::string& path, const Vec3& scale, UpAxis up) {
  check_is_file(path);
  if (!is_mesh_file(path)) fail(path, "not a kind of mesh that is known (.obj, .stl, .ply, .off, .dae, .gltf, .glb)");
  const RawMesh raw = read_raw_mesh(path, up);
  // Some kinds of files have three vertices for each triangle; those at the same place are one below.
  if (raw.vertices.size() > 3 * limits.most || raw.triangles.size() > limits.most) fail(path, limits.too_many);
  TriangleMesh mesh = welded_within(limits, path, raw, scale);
  if (mesh.vertices.size() > limits.most) fail(path, limits.too_many);
  check_is_whole(path, mesh);
  return mesh;
}

TriangleMesh read_guarded(const Limits& limits, const std::string& path, const Vec3& scale) {
  check_is_file(path);
  const std::string bytes = guarded(
      path,
      [&] {
        std::string reply;
        const TriangleMesh mesh = read_within(limits, path, scale, UpAxis::as_the_file_says);
        put(reply, mesh.vertices);
        put(reply, mesh.triangles);
        put(reply, mesh.faces);
        return reply;
      },
      allowance_for(path));
  TriangleMesh mesh;
  std::size_t at = 0;
  if (!take(bytes, at, limits.most, mesh.vertices) || !take(bytes, at, limits.most, mesh.triangles) ||
      !take(bytes, at, limits.most, mesh.faces) || at != bytes.size() || !is_sound(mesh))
    fail(path, "the reader made no sense of it");
  return mesh;
}

}  // namespace

TriangleMesh welded(const std::string& path, const RawMesh& raw, const Vec3& scale) {
  return welded_within(of_scenes, path, raw, scale);
}

bool is_mesh_file(const std::string& path) {
  const std::string kind = file_kind(path);
  return kind == "obj" || kind == "stl" || kind == "ply" || kind == "off" || kind == "dae" || kind == "gltf" ||
         kind == "glb";
}

RawMesh read_raw_mesh(const std::string& path, UpAxis up) {
  const std::string kind = file_kind(path);
  const auto read = kind == "obj"   ? read_obj
                    : kind == "ply" ? read_ply
                    : kind == "stl" ? read_stl
                    : kind == "off" ? read_off
                                    : nullptr;
  if (read == nullptr) return read_by_assimp(path, up);
  const std::string bytes = files::read_file(path, std::uint64_t{512} << 20);
  const std::string mark = bytes.substr(0, 2);
  if (mark == "\xFE\xFF" || mark == "\xFF\xFE") throw std::runtime_error("a text in UTF-16: save it as UTF-8");
  return read(bytes);
}

std::size_t left_over_vertices(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices.size());
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t corner : t) used[corner] = true;
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), false));
}

TriangleMesh read_mesh_unguarded(const std::string& path, const Vec3& scale, UpAxis up) {
  return read_within(of_scenes, path, scale, up);
}

TriangleMesh read_mesh(const std::string& path, const Vec3& scale) {
  return read_guarded(of_scenes, path, scale);
}

TriangleMesh read_surface(const std::string& path) {
  return read_guarded(of_surfaces, path, {1, 1, 1});
}

}  // namespace boxstream::imports
