// SPDX-License-Identifier: MIT
#include "formats/scene_model/expand_parts.hpp"

namespace boxstream::scenes {
namespace {

void start(Body& body, const BallStart& start, Random& random) {
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

void generate(const BallRandomGenerator& ball, Random& random, Expanded& out) {
  const std::vector<std::size_t> cards = deal(ball.mix, ball.start.count, random);
  for (const std::size_t card : cards) {
    Body body = draw_body(ball.mix[card], random, out);
    start(body, ball.start, random);
    if (ball.turned) body.rotation = random.rotation();
    out.bodies.push_back(std::move(body));
  }
}

void generate(const Assorted80Generator& assorted, Random& random, Expanded& out) {
  const Vec3 half = std::get<BoxShape>(out.shapes[assorted.unit.shape].value).half_extents;
  const auto box = [&](const Vec3& size) {
    return add_shape(out, BoxShape{{size[0] * half[0], size[1] * half[1], size[2] * half[2]}});
  };
  std::vector<std::size_t> fixed;
  for (const Vec3& size : fixed_sizes) fixed.push_back(box(size));
  for (int i = 0; i < assorted.start.count; ++i) {
    Body body;
    body.traits = assorted.unit;
    const int kind = i % period;
    if (kind < fixed_count) {
      body.traits.shape = fixed[static_cast<std::size_t>(kind)];
    } else {
      Vec3 size;
      for (double& side : size) side = random_factor * random.range(least, most);
      body.traits.shape = box(size);
    }
    start(body, assorted.start, random);
    out.bodies.push_back(std::move(body));
  }
}

}  // namespace boxstream::scenes
