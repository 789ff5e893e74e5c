// SPDX-License-Identifier: MIT
// Makes a manager of FCL that is compiled into this program, or one that the library has and nothing replaces.
#include <fcl/fcl.h>

int main() {
#ifdef BOXSTREAM_SPATIAL_HASH
  fcl::SpatialHashingCollisionManager<double> manager(1, {-5, -5, -5}, {5, 5, 5});
#else
  fcl::BOXSTREAM_MANAGER<float> manager;
#endif
  return static_cast<int>(manager.size());
}
