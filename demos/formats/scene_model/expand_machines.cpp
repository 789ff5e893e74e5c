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

void generate(const JointGridGenerator& grid, Random&, Expanded& out) {
  const int across = grid.columns[0], down = grid.columns[1];
  const std::size_t first = out.bodies.size();
  const auto place = [&](double column, double row) {
    return Vec3{grid.origin[0] + (column - 0.5 * (across - 1)) * grid.spacing[0],
                grid.origin[1] - row * grid.spacing[1], grid.origin[2]};
  };
  const auto index = [&](int column, int row) {
    return first + static_cast<std::size_t>(row) * static_cast<std::size_t>(across) + static_cast<std::size_t>(column);
  };
  for (int row = 0; row < down; ++row) {
    for (int column = 0; column < across; ++column) {
      Body body;
      body.traits = grid.node;
      body.position = place(column, row);
      out.bodies.push_back(std::move(body));
      const std::size_t here = index(column, row);
      if (column > 0) out.joints.push_back({here, here - 1, BallJoint{place(column - 0.5, row)}});
      if (row > 0) out.joints.push_back({here, index(column, row - 1), BallJoint{place(column, row - 0.5)}});
    }
  }
  const int left = (across - grid.held) / 2;
  for (int column = left; column < left + grid.held; ++column)
    out.joints.push_back({index(column, 0), std::nullopt, BallJoint{place(column, 0)}});
}

void generate(const DrumGenerator& drum, Random&, Expanded& out) {
  const double pi = std::numbers::pi;
  const double t = drum.thickness / 2, half_length = drum.length / 2;
  CompoundShape wall;
  // As wide as their outer faces: inside they reach through each other, and leave no gaps.
  const double half_width = (drum.radius + drum.thickness) * std::tan(pi / drum.staves);
  for (int i = 0; i < drum.staves; ++i)
    wall.children.push_back(around_z(out, {t, half_width, half_length}, drum.radius + t, 2 * pi * i / drum.staves));
  for (int i = 0; i < drum.paddles; ++i)
    wall.children.push_back(
        around_z(out, {drum.depth / 2, t, half_length}, drum.radius - drum.depth / 2, 2 * pi * i / drum.paddles));
  Body body;
  body.traits.shape = add_shape(out, std::move(wall));
  body.traits.type = BodyType::kinematic;
  body.traits.material = drum.material;
  body.position = drum.centre;
  body.spin = {0, 0, drum.spin};
  out.bodies.push_back(body);

  const double reach = (drum.radius + drum.thickness) / std::cos(pi / drum.staves);
  Body end;
  end.traits.shape = add_shape(out, BoxShape{{reach, reach, t}});
  end.traits.type = BodyType::fixed;
  end.traits.material = drum.material;
  for (const double side : {-1.0, 1.0}) {
    end.position = {drum.centre[0], drum.centre[1], drum.centre[2] + side * (half_length + t)};
    out.bodies.push_back(end);
  }
}

}  // namespace boxstream::scenes
