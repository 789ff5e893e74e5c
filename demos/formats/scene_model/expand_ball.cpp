// SPDX-License-Identifier: MIT
#include "formats/scene_model/expand_parts.hpp"

namespace boxstream::scenes {
namespace {

void put_in(const BallStart& start, Body& body, Random& random) {
  const Vec3 offset = random.in_ball(start.radius);
  for (std::size_t d = 0; d < 3; ++d) body.position[d] = start.centre[d] + offset[d];
  body.velocity = random.in_ball(start.speed);
}

// Sides, in units of the object scale.
constexpr double least = 0.1, most = 1.9;

constexpr Vec3 fixed_sizes[] = {
    {0.5, 0.5, 0.5},  {0.5, 0.5, 0.5},  {0.5, 0.5, 0.5},  {0.5, 0.5, 0.5},  // small cubes
    {1.9, 1.9, 1.9},  {1.9, 1.9, 1.9},  {1.9, 1.9, 1.9},  {1.9, 1.9, 1.9},  // large cubes
    {15.2, 0.4, 0.4}, {15.2, 0.4, 0.4}, {15.2, 0.4, 0.4},                   // bars
    {0.4, 15.2, 0.4}, {0.4, 0.4, 15.2},                                     //
    {1.9, 5.7, 0.1},  {1.9, 0.1, 5.7},  {0.1, 1.9, 0.3},                    // planks; the last one is short
    {3.8, 3.8, 0.1},  {3.8, 0.1, 3.8},  {0.1, 3.8, 3.8},                    // slabs
};
constexpr int fixed_count = static_cast<int>(std::size(fixed_sizes));
constexpr int period = 80;
constexpr double random_factor = 0.803;

}  // namespace

void BallRandomGenerator::generate(Random& random, Expanded& out) const {
  const std::vector<std::size_t> cards = deal(mix, start.count, random);
  for (const std::size_t card : cards) {
    Body body = draw_body(mix[card], random, out);
    put_in(start, body, random);
    if (turned) body.rotation = random.rotation();
    out.bodies.push_back(std::move(body));
  }
}

void Assorted80Generator::generate(Random& random, Expanded& out) const {
  const Vec3 half = std::get<BoxShape>(out.shapes[unit.shape].value).half_extents;
  const auto box = [&](const Vec3& size) {
    return add_shape(out, BoxShape{{size[0] * half[0], size[1] * half[1], size[2] * half[2]}});
  };
  std::vector<std::size_t> fixed;
  for (const Vec3& size : fixed_sizes) fixed.push_back(box(size));
  for (int i = 0; i < start.count; ++i) {
    Body body;
    body.traits = unit;
    const int place = i % period;
    if (place < fixed_count) {
      body.traits.shape = fixed[static_cast<std::size_t>(place)];
    } else {
      Vec3 size;
      for (double& side : size) side = random_factor * random.range(least, most);
      body.traits.shape = box(size);
    }
    put_in(start, body, random);
    out.bodies.push_back(std::move(body));
  }
}

}  // namespace boxstream::scenes
