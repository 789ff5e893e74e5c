// SPDX-License-Identifier: MIT
#pragma once

#include "drawable.hpp"

namespace boxstream::picture {

/// A mesh with one normal for each corner of each triangle, so that edges can be sharp or smooth.
struct ShadedMesh {
  struct Corner {
    Vec3 position;
    Vec3 normal;
  };
  /// Three for each triangle.
  std::vector<Corner> corners;
};

ShadedMesh tessellate(const Box& box);
ShadedMesh tessellate(const Cylinder& cylinder);
ShadedMesh tessellate(const Cone& cone);
ShadedMesh tessellate(const Mesh& mesh);

}  // namespace boxstream::picture
