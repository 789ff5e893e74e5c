// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>
#include <LinearMath/btVector3.h>

namespace boxstream::bench {

inline btVector3 vector(const float (&v)[3]) {
  return {v[0], v[1], v[2]};
}

/// Of the box that a proxy was made for.
inline std::uint32_t index_of(const btBroadphaseProxy* proxy) {
  return static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(proxy->m_clientObject));
}

}  // namespace boxstream::bench
