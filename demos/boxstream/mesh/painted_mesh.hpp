// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/output_file.hpp"
#include "formats/import/mesh.hpp"
#include "pictures/drawing/poster.hpp"

namespace boxstream::tool {

/// A surface with a colour for each vertex.
struct PaintedMesh {
  imports::TriangleMesh mesh;
  std::vector<picture::Colour> colours;  ///< as many as vertices, or none: plain
  picture::ColourBar bar{};              ///< on a .png
};

/// A file that a surface goes to, by the ending of its name: .ply has coordinates as floats, or as doubles where some
/// are no floats; .glb has floats; .png is a picture of it.
class PaintedMeshFile {
 public:
  /// Throws BadInput for any other ending, and as files::OutputFile does.
  explicit PaintedMeshFile(const std::string& path);

  /// Puts the file in its place. Throws std::runtime_error.
  void write(const PaintedMesh& painted);

 private:
  std::string kind_;
  files::OutputFile file_;
};

}  // namespace boxstream::tool
