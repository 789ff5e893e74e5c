// SPDX-License-Identifier: MIT
#include "simulation/engine/mass.hpp"

namespace boxstream::scenes {

Mass mass_of(const Body& body, const geometry::Solid& solid) {
  const BodyTraits& traits = body.traits;
  if (traits.type != BodyType::dynamic) return {};
  Mass result;
  result.mass = traits.mass ? *traits.mass : *traits.density * solid.volume;
  geometry::Tensor tensor = geometry::scaled(solid.inertia, result.mass / solid.volume);
  if (body.inertia) {
    tensor = geometry::diagonal(*body.inertia);
    const auto& [xy, xz, yz] = body.products;
    tensor = geometry::sum(tensor, {{{0, xy, xz}, {xy, 0, yz}, {xz, yz, 0}}});
  }
  const geometry::Principal axes = geometry::principal(tensor);
  result.moments = axes.moments;
  // Of moments that are given, the point is the origin, unless it is given too.
  result.frame = {body.centre.value_or(body.inertia ? Vec3{} : solid.centroid), axes.turn};
  return result;
}

}  // namespace boxstream::scenes
