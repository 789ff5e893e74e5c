// SPDX-License-Identifier: MIT
// Both precisions in one program: FCL's library has the double one only, the other comes from its headers.
#include <boxstream/fcl.hpp>
#include <boxstream/fcl/tight_box.hpp>

#include <fcl/geometry/shape/sphere.h>

#include <cstdio>
#include <memory>
#include <vector>

#ifdef __AVX__
#error "the target passes flags on that change the layout of FCL's types"
#endif

namespace {

template <class S>
bool count(fcl::CollisionObject<S>*, fcl::CollisionObject<S>*, void* calls) {
  ++*static_cast<int*>(calls);
  return false;
}

template <class S>
bool count_distances(fcl::CollisionObject<S>*, fcl::CollisionObject<S>*, void* calls, S& dist) {
  ++*static_cast<int*>(calls);
  dist = S(0.1);
  return false;
}

/// A row of spheres, each touching the next.
template <class S>
bool works() {
  const int n = 200;
  const auto sphere = std::make_shared<fcl::Sphere<S>>(S(0.5));
  std::vector<std::unique_ptr<fcl::CollisionObject<S>>> objects;
  boxstream::fcl::CollisionManager<S> manager;
  for (int i = 0; i < n; ++i) {
    objects.push_back(std::make_unique<fcl::CollisionObject<S>>(sphere));
    objects.back()->setTranslation(fcl::Vector3<S>(S(i), 0, 0));
    objects.back()->computeAABB();
    manager.registerObject(objects.back().get());
  }
  int pairs = 0, neighbours = 0, near = 0;
  manager.collide(&pairs, count<S>);
  manager.collide(objects[n / 2].get(), &neighbours, count<S>);
  manager.distance(&near, count_distances<S>);
  manager.setBoxSource(boxstream::fcl::tightBox<S>);
  manager.update();
  const bool good = pairs == n - 1 && neighbours == 2 && near == n - 1;
  if (!good) std::printf("%d pairs, %d neighbours, %d near\n", pairs, neighbours, near);
  return good;
}

}  // namespace

int main() {
  return works<float>() && works<double>() ? 0 : 1;
}
