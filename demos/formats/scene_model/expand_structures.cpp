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

void generate(const PyramidGenerator& pyramid, Random&, Expanded& out) {
  const Vec3 half = std::get<BoxShape>(out.shapes[pyramid.brick.shape].value).half_extents;
  const double dx = 2 * half[0] + pyramid.gap, dz = 2 * half[2] + pyramid.gap;
  const double radians = pyramid.degrees * std::numbers::pi / 180;
  const Vec3 spacing{pyramid.spacing[0], 0, pyramid.spacing[1]};
  for (int copy = 0; copy < pyramid.repeat[0] * pyramid.repeat[1]; ++copy) {
    const Vec3 origin = lattice_place(copy, pyramid.repeat, spacing, pyramid.origin);
    for (int level = 0; level < pyramid.levels; ++level) {
      const int side = pyramid.levels - level, depth = pyramid.flat ? 1 : side;
      for (int z = 0; z < depth; ++z)
        for (int x = 0; x < side; ++x)
          out.bodies.push_back(brick_at(
              pyramid.brick, origin,
              {(x - 0.5 * (side - 1)) * dx, half[1] * (2 * level + 1), (z - 0.5 * (depth - 1)) * dz}, radians));
    }
  }
}

void generate(const TowerGenerator& tower, Random&, Expanded& out) {
  const Vec3 half = std::get<BoxShape>(out.shapes[tower.brick.shape].value).half_extents;
  const double pitch = 2 * std::numbers::pi / tower.around;
  const double inside = (half[0] + tower.gap / 2) / std::tan(pitch / 2);  // to the inner faces
  for (int level = 0; level < tower.levels; ++level)
    for (int i = 0; i < tower.around; ++i)
      out.bodies.push_back(brick_at(tower.brick, tower.origin, {0, half[1] * (2 * level + 1), inside + half[2]},
                                    pitch * (i + 0.5 * (level % 2))));
}

void generate(const ScatterGenerator& scatter, Random& random, Expanded& out) {
  const std::vector<std::size_t> cards = deal(scatter.mix, scatter.count, random);
  for (int i = 0; i < scatter.count; ++i) {
    Body body = draw_body(scatter.mix[cards[static_cast<std::size_t>(i)]], random, out);
    body.position = {scatter.origin[0] + (radical_inverse(i + 1, 2) - 0.5) * scatter.size[0],
                     scatter.origin[1] + radical_inverse(i + 1, 3) * scatter.size[1],
                     scatter.origin[2] + (radical_inverse(i + 1, 5) - 0.5) * scatter.size[2]};
    if (scatter.turned) body.rotation = random.rotation();
    out.bodies.push_back(std::move(body));
  }
}

void generate(const RespawnGenerator& respawn, Random& random, Expanded& out) {
  const std::vector<std::size_t> cards = deal(respawn.mix, respawn.count, random);
  for (const std::size_t card : cards) {
    Body body = draw_body(respawn.mix[card], random, out);
    body.position = respawn.origin;
    body.velocity = respawn.velocity;
    body.late = true;
    out.bodies.push_back(std::move(body));
  }
}

}  // namespace boxstream::scenes
