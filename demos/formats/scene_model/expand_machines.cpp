// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "formats/scene_model/expand_parts.hpp"

namespace boxstream::scenes {
namespace {

/// A box of a compound, `distance` from the z axis in a direction at this angle, its x pointing away from the axis.
CompoundChild around_z(Expanded& out, const Vec3& half_extents, double distance, double radians) {
  return {add_shape(out, BoxShape{half_extents}),
          {distance * std::cos(radians), distance * std::sin(radians), 0},
          {0, 0, std::sin(radians / 2), std::cos(radians / 2)}};
}

}  // namespace

void JointGridGenerator::generate(Random&, Expanded& out) const {
  const int across = columns[0], down = columns[1];
  const std::size_t first = out.bodies.size();
  const auto place = [&](double column, double row) {
    return Vec3{origin[0] + (column - 0.5 * (across - 1)) * spacing[0], origin[1] - row * spacing[1], origin[2]};
  };
  const auto index = [&](int column, int row) {
    return first + static_cast<std::size_t>(row) * static_cast<std::size_t>(across) + static_cast<std::size_t>(column);
  };
  for (int row = 0; row < down; ++row) {
    for (int column = 0; column < across; ++column) {
      Body body;
      body.traits = node;
      body.position = place(column, row);
      out.bodies.push_back(std::move(body));
      const std::size_t here = index(column, row);
      if (column > 0) out.joints.push_back({here, here - 1, BallJoint{place(column - 0.5, row)}});
      if (row > 0) out.joints.push_back({here, index(column, row - 1), BallJoint{place(column, row - 0.5)}});
    }
  }
  const int left = (across - held) / 2;
  for (int column = left; column < left + held; ++column)
    out.joints.push_back({index(column, 0), std::nullopt, BallJoint{place(column, 0)}});
}

void DrumGenerator::generate(Random&, Expanded& out) const {
  const double pi = std::numbers::pi;
  const double t = thickness / 2, half_length = length / 2;
  CompoundShape wall;
  // As wide as their outer faces: inside they reach through each other, and leave no gaps.
  const double half_width = (radius + thickness) * std::tan(pi / staves);
  for (int i = 0; i < staves; ++i)
    wall.children.push_back(around_z(out, {t, half_width, half_length}, radius + t, 2 * pi * i / staves));
  for (int i = 0; i < paddles; ++i)
    wall.children.push_back(around_z(out, {depth / 2, t, half_length}, radius - depth / 2, 2 * pi * i / paddles));
  Body body;
  body.traits.shape = add_shape(out, std::move(wall));
  body.traits.type = BodyType::kinematic;
  body.traits.material = material;
  body.position = centre;
  body.spin = {0, 0, spin};
  out.bodies.push_back(body);

  const double reach = (radius + thickness) / std::cos(pi / staves);
  Body end;
  end.traits.shape = add_shape(out, BoxShape{{reach, reach, t}});
  end.traits.type = BodyType::fixed;
  end.traits.material = material;
  for (const double side : {-1.0, 1.0}) {
    end.position = {centre[0], centre[1], centre[2] + side * (half_length + t)};
    out.bodies.push_back(end);
  }
}

}  // namespace boxstream::scenes
