// SPDX-License-Identifier: MIT
// A manager of FCL on boxstream: registered, updated and queried as FCL's own.
#include <fcl/fcl.h>
#include <boxstream/fcl.hpp>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <vector>

using Manager = boxstream::fcl::CollisionManager<double>;  // was: fcl::DynamicAABBTreeCollisionManagerd
using Object = fcl::CollisionObjectd;

int main() {
  std::vector<std::unique_ptr<Object>> objects;
  Manager manager;
  for (int i = 0; i < 4; ++i) {
    objects.push_back(std::make_unique<Object>(std::make_shared<fcl::Sphered>(0.5)));
    objects.back()->setTranslation(fcl::Vector3d(0.75 * i * i, 0, 0));
    objects.back()->computeAABB();
    manager.registerObject(objects.back().get());
  }
  manager.setup();

  std::size_t touching = 0;
  manager.collide(&touching, [](Object* a, Object* b, void* data) {
    fcl::CollisionResultd result;
    *static_cast<std::size_t*>(data) += fcl::collide(a, b, fcl::CollisionRequestd(), result) > 0;
    return false;  // go on
  });
  std::printf("%zu pairs of spheres touch\n", touching);

  // How near the last comes to any other. The limit that the callback leaves in `least` spares pairs beyond it.
  Object probe(std::make_shared<fcl::Sphered>(0.5), fcl::Matrix3d::Identity(), fcl::Vector3d(5, 0, 0));
  probe.computeAABB();
  double nearest = std::numeric_limits<double>::max();
  manager.distance(&probe, &nearest, [](Object* a, Object* b, void* data, double& least) {
    fcl::DistanceResultd result;
    double& found = *static_cast<double*>(data);
    found = std::min(found, fcl::distance(a, b, fcl::DistanceRequestd(), result));
    least = found;
    return false;
  });
  std::printf("the probe is %.2f from the nearest\n", nearest);
}
