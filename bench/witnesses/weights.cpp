// SPDX-License-Identifier: MIT
#include "witnesses/weights.hpp"

#include "formats/geometry/convex_hull.hpp"
#include "formats/geometry/solid.hpp"
#include "witnesses/witness.hpp"

namespace boxstream::witnesses {
namespace {

geometry::Solid solid_of(const std::vector<scenes::Shape>& shapes, std::size_t index) {
  const auto of = [&]<class S>(const S& s) -> geometry::Solid {
    if constexpr (std::is_same_v<S, scenes::BoxShape>) {
      return geometry::box(s.half_extents);
    } else if constexpr (std::is_same_v<S, scenes::SphereShape>) {
      return geometry::ball(s.radius);
    } else if constexpr (std::is_same_v<S, scenes::CapsuleShape>) {
      return geometry::capsule(s.radius, s.height);
    } else if constexpr (std::is_same_v<S, scenes::CylinderShape>) {
      return geometry::cylinder(s.radius, s.height);
    } else if constexpr (std::is_same_v<S, scenes::ConeShape>) {
      return geometry::cone(s.radius, s.height);
    } else if constexpr (std::is_same_v<S, scenes::HullShape>) {
      if (const auto hull = geometry::convex_hull(s.points)) return geometry::solid_of(*hull);
      throw Unknown("a flat hull");
    } else if constexpr (std::is_same_v<S, scenes::CompoundShape>) {
      std::vector<geometry::Solid> parts;
      for (const scenes::CompoundChild& child : s.children)
        parts.push_back(geometry::placed({child.position, child.rotation}, solid_of(shapes, child.shape)));
      return geometry::sum(parts);
    } else {
      throw Unknown("a moving shape that is no solid");
    }
  };
  return std::visit(of, shapes[index].value);
}

}  // namespace

Weight weight_of(const scenes::Expanded& expanded, const scenes::Body& body) {
  const geometry::Solid solid = solid_of(expanded.shapes, body.traits.shape);
  Weight weight;
  weight.mass = body.traits.mass ? *body.traits.mass : *body.traits.density * solid.volume;
  if (body.inertia) {
    const auto& [xy, xz, yz] = body.products;
    weight.inertia = geometry::sum(geometry::diagonal(*body.inertia), {{{0, xy, xz}, {xy, 0, yz}, {xz, yz, 0}}});
    weight.centre = body.centre.value_or(scenes::Vec3{});
  } else {
    weight.inertia = geometry::scaled(solid.inertia, weight.mass / solid.volume);
    weight.centre = body.centre.value_or(solid.centroid);
  }
  return weight;
}

}  // namespace boxstream::witnesses
