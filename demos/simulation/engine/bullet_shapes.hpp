// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <BulletCollision/CollisionShapes/btStridingMeshInterface.h>

#include "formats/geometry/convex_hull.hpp"
#include "formats/geometry/solid.hpp"
#include "formats/scene_model/scene.hpp"
#include "simulation/engine/drawable.hpp"

namespace boxstream::scenes {

/// What of a shape has to be known beside Bullet's object.
struct BuiltShape {
  double volume = 0;      // of solid shapes
  geometry::Frame frame;  // Bullet's, in the coordinates of the description
  /// For drawing: one drawable in the coordinates of the description, or one for each child of a compound.
  std::vector<Drawable> drawables;

  // What Bullet's shape and the drawables point into.
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<float> heights;
  std::unique_ptr<btStridingMeshInterface> mesh;
  std::unique_ptr<btCollisionShape> part;

  std::unique_ptr<btCollisionShape> shape;  // goes first
};

/// Bullet's shapes for a list of described ones, built when first used. Owns them; references stay valid.
class ShapeSet {
 public:
  explicit ShapeSet(std::vector<Shape> shapes);

  /// What a shape of density 1 weighs, in the coordinates of the description; nothing if it is no solid.
  const geometry::Solid& solid(std::size_t index);

  /// Built around the origin of `frame` and along its axes. Height fields are always built around their middle height.
  const BuiltShape& get(std::size_t index, const geometry::Frame& frame = {});

  /// The convex hull of a hull's points.
  const geometry::Hull& hull(std::size_t index);

  /// What the file says.
  const ShapeValue& described(std::size_t index) const { return shapes_[index].value; }
  std::optional<double> margin(std::size_t index) const { return shapes_[index].margin; }

 private:
  using Key = std::pair<std::size_t, std::array<double, 7>>;

  std::vector<Shape> shapes_;
  std::map<Key, std::unique_ptr<BuiltShape>> built_;
  std::vector<std::unique_ptr<geometry::Solid>> solids_;
  std::vector<std::unique_ptr<geometry::Hull>> hulls_;
};

}  // namespace boxstream::scenes
