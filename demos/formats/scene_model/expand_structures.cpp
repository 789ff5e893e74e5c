// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "formats/scene_model/expand_parts.hpp"

namespace boxstream::scenes {
namespace {

/// Turned by an angle about the vertical.
Quat heading(double radians) {
  return {0, std::sin(radians / 2), 0, std::cos(radians / 2)};
}

Body brick_at(const BodyTraits& traits, const Vec3& origin, const Vec3& offset, double radians) {
  Body body;
  body.traits = traits;
  body.rotation = heading(radians);
  const Vec3 place = turned(body.rotation, offset);
  for (std::size_t d = 0; d < 3; ++d) body.position[d] = origin[d] + place[d];
  return body;
}

/// The digits of `index` in this base, mirrored at the point: in (0, 1), and evenly spread for 1, 2, 3 ...
double radical_inverse(int index, int base) {
  double inverse = 0, place = 1;
  for (; index > 0; index /= base) inverse += (place /= base) * (index % base);
  return inverse;
}

}  // namespace

void PyramidGenerator::generate(Random&, Expanded& out) const {
  const Vec3 half = std::get<BoxShape>(out.shapes[brick.shape].value).half_extents;
  const double dx = 2 * half[0] + gap, dz = 2 * half[2] + gap;
  const double radians = degrees * std::numbers::pi / 180;
  const Vec3 pitch{spacing[0], 0, spacing[1]};
  for (int copy = 0; copy < repeat[0] * repeat[1]; ++copy) {
    const Vec3 foot = lattice_place(copy, repeat, pitch, origin);
    for (int level = 0; level < levels; ++level) {
      const int side = levels - level, depth = flat ? 1 : side;
      for (int z = 0; z < depth; ++z)
        for (int x = 0; x < side; ++x)
          out.bodies.push_back(brick_at(
              brick, foot, {(x - 0.5 * (side - 1)) * dx, half[1] * (2 * level + 1), (z - 0.5 * (depth - 1)) * dz},
              radians));
    }
  }
}

void TowerGenerator::generate(Random&, Expanded& out) const {
  const Vec3 half = std::get<BoxShape>(out.shapes[brick.shape].value).half_extents;
  const double pitch = 2 * std::numbers::pi / around;
  const double inside = (half[0] + gap / 2) / std::tan(pitch / 2);  // to the inner faces
  for (int level = 0; level < levels; ++level)
    for (int i = 0; i < around; ++i)
      out.bodies.push_back(
          brick_at(brick, origin, {0, half[1] * (2 * level + 1), inside + half[2]}, pitch * (i + 0.5 * (level % 2))));
}

void ScatterGenerator::generate(Random& random, Expanded& out) const {
  const std::vector<std::size_t> cards = deal(mix, count, random);
  for (int i = 0; i < count; ++i) {
    Body body = draw_body(mix[cards[static_cast<std::size_t>(i)]], random, out);
    body.position = {origin[0] + (radical_inverse(i + 1, 2) - 0.5) * size[0],
                     origin[1] + radical_inverse(i + 1, 3) * size[1],
                     origin[2] + (radical_inverse(i + 1, 5) - 0.5) * size[2]};
    if (turned) body.rotation = random.rotation();
    out.bodies.push_back(std::move(body));
  }
}

void RespawnGenerator::generate(Random& random, Expanded& out) const {
  const std::vector<std::size_t> cards = deal(mix, count, random);
  for (const std::size_t card : cards) {
    Body body = draw_body(mix[card], random, out);
    body.position = origin;
    body.velocity = velocity;
    body.late = true;
    out.bodies.push_back(std::move(body));
  }
}

}  // namespace boxstream::scenes
