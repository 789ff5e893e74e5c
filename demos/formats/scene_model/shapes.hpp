// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// What a shape may be used for: as a part of a compound and of any body, of any body, or of fixed bodies only.
enum class ShapeUse { part, any_body, fixed_body };

// Each kind has the name of its "type", that of its count in "expect", and its use. Parts of compounds can be resized,
// and know half their thinnest extent, but for hulls: what a body may move in a step without jumping over something.

struct BoxShape {
  static constexpr const char *kind = "box", *plural = "boxes";
  static constexpr ShapeUse use = ShapeUse::part;
  Vec3 half_extents;

  void resize(double factor) { half_extents = times(half_extents, factor); }
  double half_thickness() const { return std::min({half_extents[0], half_extents[1], half_extents[2]}); }
};
struct SphereShape {
  static constexpr const char *kind = "sphere", *plural = "spheres";
  static constexpr ShapeUse use = ShapeUse::part;
  double radius;

  void resize(double factor) { radius *= factor; }
  double half_thickness() const { return radius; }
};
/// Along local y; `height` is between the centres of the two end spheres.
struct CapsuleShape {
  static constexpr const char *kind = "capsule", *plural = "capsules";
  static constexpr ShapeUse use = ShapeUse::part;
  double radius;
  double height;

  void resize(double factor) { radius *= factor, height *= factor; }
  double half_thickness() const { return radius; }
};
/// Along local y; `height` is the whole height, centred.
struct CylinderShape {
  static constexpr const char *kind = "cylinder", *plural = "cylinders";
  static constexpr ShapeUse use = ShapeUse::part;
  double radius;
  double height;

  void resize(double factor) { radius *= factor, height *= factor; }
  double half_thickness() const { return std::min(radius, height / 2); }
};
struct ConeShape {
  static constexpr const char *kind = "cone", *plural = "cones";
  static constexpr ShapeUse use = ShapeUse::part;
  double radius;
  double height;

  void resize(double factor) { radius *= factor, height *= factor; }
  double half_thickness() const { return std::min(radius, height) / 2; }
};
struct HullShape {
  static constexpr const char *kind = "hull", *plural = "hulls";
  static constexpr ShapeUse use = ShapeUse::part;
  std::vector<Vec3> points;

  void resize(double factor) {
    for (Vec3& p : points) p = times(p, factor);
  }
};
/// The half-space { x : normal . x <= offset } is solid.
struct PlaneShape {
  static constexpr const char *kind = "plane", *plural = "planes";
  static constexpr ShapeUse use = ShapeUse::fixed_body;
  Vec3 normal;
  double offset;
};
/// A grid of heights, row after row along z, centred on the body's position in x and z.
struct HeightfieldShape {
  static constexpr const char *kind = "heightfield", *plural = "heightfields";
  static constexpr ShapeUse use = ShapeUse::fixed_body;
  int columns;
  int rows;
  double cell;
  std::vector<float> heights;
};
struct MeshShape {
  static constexpr const char *kind = "mesh", *plural = "meshes";
  static constexpr ShapeUse use = ShapeUse::fixed_body;
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  bool internal_edges = false;  // keep bodies from stumbling over edges inside the surface
};
struct CompoundChild {
  std::size_t shape;  // an earlier one
  Vec3 position;
  Quat rotation;
};
struct CompoundShape {
  static constexpr const char *kind = "compound", *plural = "compounds";
  static constexpr ShapeUse use = ShapeUse::any_body;
  std::vector<CompoundChild> children;
};

using ShapeValue = std::variant<BoxShape, SphereShape, CapsuleShape, CylinderShape, ConeShape, HullShape, PlaneShape,
                                HeightfieldShape, MeshShape, CompoundShape>;

inline ShapeUse use_of(const ShapeValue& shape) {
  return std::visit([]<class S>(const S&) { return S::use; }, shape);
}

struct Shape {
  std::string name;
  ShapeValue value;
  /// Of boxes, cylinders, cones and hulls: by how much edges and corners are rounded, inside of what is described.
  /// Absent: the engine's for boxes and cylinders, none for cones and hulls.
  std::optional<double> margin{};
};

}  // namespace boxstream::scenes
