// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include <boxstream/world.hpp>

#include "precision.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

inline constexpr std::uint32_t no_link = ~std::uint32_t{0};
inline constexpr std::uint32_t no_place = ~std::uint32_t{0};

/// What users see as btBroadphaseProxy, with what the adapter knows about it. In single precision all that passes over
/// all proxies look at, up to `told`, fills one cache line.
struct alignas(64) Proxy : btBroadphaseProxy {
  Proxy(const btVector3& lo, const btVector3& hi, void* client, int group, int mask)
      : btBroadphaseProxy(lo, hi, client, group, mask) {}

  Filter told;                               ///< what the World was told; users write the fields at any time
  ProxyId id;                                ///< null until the World has been told
  std::uint32_t position = 0;                ///< in the list of live proxies
  std::uint32_t untold_position = no_place;  ///< in the list of those whose box the World has not been told
  bool dying = false;                        ///< destroyed while the World was busy
  bool is_ghost = false;                     ///< what judged_client is
  const void* judged_client = nullptr;

  // The list of its pairs: see PairLinks.
  std::uint64_t links_epoch = 0;
  std::uint32_t first_link = no_link;
  std::uint32_t degree = 0;
};

inline BasicAabb<btScalar> box_of(const btVector3& lo, const btVector3& hi) {
  return {{lo.x(), lo.y(), lo.z()}, {hi.x(), hi.y(), hi.z()}};
}

/// While unique ids grow in order of creation, keys sort as the World orders its pairs.
inline std::uint64_t pair_key(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const auto x = std::uint32_t(a.m_uniqueId), y = std::uint32_t(b.m_uniqueId);
  return std::uint64_t(x < y ? x : y) << 32 | (x < y ? y : x);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
