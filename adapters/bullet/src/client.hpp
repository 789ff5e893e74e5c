// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include <boxstream/bullet/precision.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// A client as the collision object that it is taken for. Callers without collision objects often pass an index: then
/// null.
inline const btCollisionObject* as_object(const void* client) {
  constexpr std::uintptr_t lowest_address = 65536;
  const auto address = reinterpret_cast<std::uintptr_t>(client);
  if (address < lowest_address || address % alignof(btCollisionObject) != 0) return nullptr;
  return static_cast<const btCollisionObject*>(client);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
