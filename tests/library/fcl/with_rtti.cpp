// SPDX-License-Identifier: MIT
// The other half of without_rtti.cpp.
#include <boxstream/fcl.hpp>

#include <cstddef>
#include <memory>

using Manager = boxstream::fcl::CollisionManager<double>;
using Object = fcl::CollisionObject<double>;

std::size_t pairs_with_rtti(Manager& mine, fcl::BroadPhaseCollisionManager<double>& other);
std::unique_ptr<Manager> manager_with_rtti();

std::size_t pairs_with_rtti(Manager& mine, fcl::BroadPhaseCollisionManager<double>& other) {
  std::size_t calls = 0;
  mine.collide(&other, &calls, [](Object*, Object*, void* count) {
    ++*static_cast<std::size_t*>(count);
    return false;
  });
  return calls;
}

std::unique_ptr<Manager> manager_with_rtti() {
  return std::make_unique<Manager>();
}
