// SPDX-License-Identifier: MIT
// Which pairs are wanted: by group and mask bits, and by a user's function.
#include <boxstream/boxstream.hpp>

#include <cstdio>
#include <vector>

int main() {
  enum : std::uint32_t { player = 1, enemy = 2, bullet = 4 };
  // Bullets of players hit enemies and nothing else; all four boxes overlap.
  const std::vector<boxstream::Aabb> boxes(4, {{0, 0, 0}, {1, 1, 1}});
  const std::vector<boxstream::Filter> filters = {
      {player, enemy},  // group, mask
      {enemy, player | bullet},
      {bullet, enemy},
      {bullet, enemy},
  };

  boxstream::Detector detector;
  std::vector<boxstream::Pair> pairs;
  detector.find_pairs(boxes, pairs);
  std::printf("without filters: %zu pairs\n", pairs.size());
  detector.find_pairs(boxes, pairs, filters);
  for (const auto [a, b] : pairs) std::printf("by group and mask: %u and %u\n", a, b);

  // In a World a function may refuse pairs as well, here those of one owner.
  boxstream::World world;
  for (std::size_t i = 0; i < boxes.size(); ++i) world.create(boxes[i], filters[i], i % 2);
  world.update([&](boxstream::ProxyId a, boxstream::ProxyId b) { return world.user(a) != world.user(b); });
  for (const auto [a, b] : world.begun()) std::printf("of two owners: %u and %u\n", a.slot, b.slot);
}
