// SPDX-License-Identifier: MIT
#include "body.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace boxstream::poses {

Real Body::reach(const Vec& unit) const {
  Real most = -std::numeric_limits<Real>::infinity();
  for (const Vec& p : points) most = std::max(most, unit.dot(p));
  for (const Disc& d : discs) {
    const Vec across = unit - unit.dot(d.axis) * d.axis;
    most = std::max(most, unit.dot(d.centre) + d.radius * across.norm());
  }
  return most + margin;
}

Body body_of(const Solid& solid, const Eigen::Vector3d& origin) {
  const Eigen::Matrix<Real, 3, 3> turn = solid.rotation.cast<Real>();
  const Vec place = solid.translation.cast<Real>() - origin.cast<Real>();
  const Vec axis = turn.col(2).normalized();
  const Real half = static_cast<Real>(solid.size[1]) / 2;
  Body body;
  switch (solid.kind) {
    case Kind::half_space: {
      const Vec normal(solid.size[0], solid.size[1], solid.size[2]);
      body.normals.push_back((turn * normal).normalized());
      body.points.push_back(turn * (normal * solid.size[3]) + place);
      body.below_plane = true;
      break;
    }
    case Kind::sphere:
      body.points.push_back(place);
      body.margin = solid.size[0];
      break;
    case Kind::capsule:
      body.points = {turn.col(2) * half + place, turn.col(2) * -half + place};
      body.edges.push_back({place, axis});
      body.margin = solid.size[0];
      break;
    case Kind::cylinder:
    case Kind::cone:
      body.discs.push_back({turn.col(2) * -half + place, axis, solid.size[0]});
      if (solid.kind == Kind::cylinder) {
        body.discs.push_back({turn.col(2) * half + place, axis, solid.size[0]});
        body.rings.push_back({axis, 0});
      } else {
        body.points.push_back(turn.col(2) * half + place);
        body.rings.push_back({axis, solid.size[0] / std::hypot(static_cast<Real>(solid.size[0]), 2 * half)});
      }
      body.normals.push_back(axis);
      body.edges.push_back({place, axis});
      break;
    default:
      for (const Eigen::Vector3d& p : solid.points) body.points.push_back(turn * p.cast<Real>() + place);
      for (const std::vector<int>& face : solid.faces) {
        const auto corner = [&](std::size_t i) -> const Vec& {
          return body.points[static_cast<std::size_t>(face[i % face.size()])];
        };
        body.normals.push_back((corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized());
        for (std::size_t i = 0; i < face.size(); ++i)
          if (face[i] < face[(i + 1) % face.size()])
            body.edges.push_back({corner(i), (corner(i + 1) - corner(i)).normalized()});
      }
  }
  return body;
}

}  // namespace boxstream::poses
