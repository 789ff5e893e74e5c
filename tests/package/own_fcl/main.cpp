// SPDX-License-Identifier: MIT
#include <fcl/geometry/shape/box.h>
#include <boxstream/fcl.hpp>

#include <memory>

int main() {
  const auto shape = std::make_shared<fcl::Boxd>(1, 1, 1);
  fcl::CollisionObjectd a(shape), b(shape);
  boxstream::fcl::CollisionManager<double> manager;
  manager.registerObjects({&a, &b});
  int pairs = 0;
  manager.collide(&pairs, [](fcl::CollisionObjectd*, fcl::CollisionObjectd*, void* count) {
    ++*static_cast<int*>(count);
    return false;
  });
  return pairs == 1 ? 0 : 1;
}
