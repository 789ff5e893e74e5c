// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/CollisionShapes/btStridingMeshInterface.h>

#include "formats/scene_model/scene.hpp"
#include "simulation/engine/drawable.hpp"

namespace boxstream::scenes {

/// What of a shape has to be known beside Bullet's object.
struct BuiltShape {
  double volume = 0;  // of solid shapes
  float lift = 0;     // what Bullet's origin is above ours (height fields are centred in height)
  /// For drawing: one drawable in local coordinates, or one for each child of a compound.
  std::vector<Drawable> drawables;

  // What Bullet's shape and the drawables point into.
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<float> heights;
  std::unique_ptr<btStridingMeshInterface> mesh;

  std::unique_ptr<btCollisionShape> shape;  // goes first
};

/// Bullet's shapes for a list of described ones, built when first used. Owns them; references stay valid.
class ShapeSet {
 public:
  explicit ShapeSet(std::vector<Shape> shapes);

  const BuiltShape& get(std::size_t index);

 private:
  std::vector<Shape> shapes_;
  std::vector<std::unique_ptr<BuiltShape>> built_;
};

}  // namespace boxstream::scenes
