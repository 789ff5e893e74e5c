// SPDX-License-Identifier: MIT
#include "simulation/engine/solid_parts.hpp"

#include <cmath>

#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

void add_parts(ShapeSet& shapes, std::size_t shape, const btTransform& pose, std::vector<SolidPart>& parts) {
  const ShapeValue& value = shapes.described(shape);
  if (const auto* const compound = std::get_if<CompoundShape>(&value)) {
    for (const CompoundChild& child : compound->children)
      add_parts(shapes, child.shape, pose * transform(child.position, child.rotation), parts);
  } else if (use_of(value) == ShapeUse::part) {
    const bool is_hull = std::holds_alternative<HullShape>(value);
    parts.push_back({&value, is_hull ? &shapes.hull(shape) : nullptr, pose});
  }
}

}  // namespace

std::vector<SolidPart> solid_parts(ShapeSet& shapes, std::size_t shape, const btTransform& frame) {
  std::vector<SolidPart> parts;
  add_parts(shapes, shape, frame, parts);
  return parts;
}

double reach(const SolidPart& part) {
  const auto of = [&]<class S>(const S& s) -> double {
    if constexpr (std::is_same_v<S, BoxShape>) {
      return std::hypot(s.half_extents[0], s.half_extents[1], s.half_extents[2]);
    } else if constexpr (std::is_same_v<S, SphereShape>) {
      return s.radius;
    } else if constexpr (std::is_same_v<S, CapsuleShape>) {
      return s.radius + s.height / 2;
    } else if constexpr (std::is_same_v<S, CylinderShape> || std::is_same_v<S, ConeShape>) {
      return std::hypot(s.radius, s.height / 2);
    } else {
      double most = 0;
      for (const Vec3& v : part.hull->points) most = std::max(most, std::hypot(v[0], v[1], v[2]));
      return most;
    }
  };
  return std::visit(of, *part.shape);
}

Facets facets(const SolidPart& part) {
  Facets all;
  if (const auto* const box = std::get_if<BoxShape>(part.shape)) {
    // A corner's number has a bit for each axis.
    for (int corner = 0; corner < 8; ++corner) {
      const auto side = [&](int axis) {
        return real((corner >> axis & 1) != 0 ? box->half_extents[static_cast<std::size_t>(axis)]
                                              : -box->half_extents[static_cast<std::size_t>(axis)]);
      };
      all.vertices.push_back(part.pose * btVector3(side(0), side(1), side(2)));
    }
    all.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                     {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  } else if (std::holds_alternative<HullShape>(*part.shape)) {
    for (const Vec3& v : part.hull->points) all.vertices.push_back(part.pose * vector(v));
    all.triangles = part.hull->triangles;
  }
  return all;
}

}  // namespace boxstream::scenes
