// SPDX-License-Identifier: MIT
// Boxes that live from frame to frame: which pairs begin and end, and what a ray meets.
#include <boxstream/boxstream.hpp>

#include <cstdio>

namespace {

enum Thing : std::uint64_t { floor_thing, ball_thing, wall_thing };
constexpr const char* names[] = {"floor", "ball", "wall"};

}  // namespace

int main() {
  boxstream::World world;
  const auto name = [&](boxstream::ProxyId id) { return names[world.user(id)]; };
  world.create({{-10, -1, -10}, {10, 0, 10}}, {}, floor_thing);
  const boxstream::ProxyId ball = world.create({{0, 2, 0}, {1, 3, 1}}, {}, ball_thing);
  world.create({{5, 0, -10}, {6, 4, 10}}, {}, wall_thing);
  world.update();

  // The ball drops, rolls to the wall and bounces off it.
  const float path[][2] = {{0, 1}, {0, 0}, {2, 0}, {4, 0}, {3, 0.5F}};
  for (const auto& [x, y] : path) {
    world.move(ball, {{x, y, 0}, {x + 1, y + 1, 1}});
    world.update();
    for (const auto [a, b] : world.begun()) std::printf("at (%g, %g): %s meets %s\n", x, y, name(a), name(b));
    for (const auto [a, b] : world.ended()) std::printf("at (%g, %g): %s leaves %s\n", x, y, name(a), name(b));
  }

  const float origin[] = {-5, 1, 0.5F}, direction[] = {1, 0, 0};
  world.query_ray(boxstream::Ray::along(origin, direction, 100), [&](boxstream::ProxyId id, float enter, float length) {
    std::printf("the ray meets %s at %g\n", name(id), enter);
    return length;  // go on to all others
  });
}
