// SPDX-License-Identifier: MIT
#include "minimal.hpp"

/// falling.json by hand.
int main(int, char** argv) {
  using namespace boxstream::effects_test;
  const int steps = std::atoi(argv[1]);
  btStaticPlaneShape floor(btVector3(0, 1, 0), 0);
  btBoxShape box(btVector3(0.5f, 0.5f, 0.5f));
  MinimalWorld minimal;
  minimal.add(floor, 0, at(0, 0, 0), btCollisionObject::CF_STATIC_OBJECT);
  for (int y = 0; y < 4; ++y)
    for (int z = 0; z < 5; ++z)
      for (int x = 0; x < 5; ++x) minimal.add(box, 1, at((x - 2) * 1.0625, 0.75 + y * 1.25, (z - 2) * 1.0625));
  for (int i = 0; i < steps; ++i) minimal.world.stepSimulation(MinimalWorld::step, 0);
  minimal.print_hash();
  return 0;
}
