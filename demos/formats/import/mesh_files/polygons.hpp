// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "formats/import/mesh_files/mesh_files.hpp"

namespace boxstream::imports {

/// Collects the faces of a file, which are counted from 0.
class Polygons {
 public:
  explicit Polygons(RawMesh& mesh) : mesh_(mesh) {}

  /// One more face; its vertices may come later. Of fewer than three corners it has no triangle.
  void add(const std::vector<std::uint32_t>& corners);

  /// After the last vertex: cuts faces into triangles, convex ones as a fan, others ear by ear, as they look along the
  /// axis on which their normal is largest. Throws std::runtime_error for a corner that is no vertex, and for a face of
  /// more than 2000 corners that a fan would give another area.
  void finish();

  std::size_t size() const { return ends_.size(); }

 private:
  void cut(std::uint32_t face, const std::uint32_t* corners, std::size_t count);
  void triangle(std::uint32_t face, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.push_back({a, b, c});
    mesh_.faces.push_back(face);
  }

  RawMesh& mesh_;
  std::vector<std::uint32_t> corners_;
  std::vector<std::size_t> ends_;
};

}  // namespace boxstream::imports
