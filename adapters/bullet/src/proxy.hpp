// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include <boxstream/world.hpp>

#include "precision.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

inline constexpr std::uint32_t no_link = ~std::uint32_t{0};

/// What users see as btBroadphaseProxy, with what the adapter knows about it. In single precision all that passes over
/// all proxies look at, up to `told`, fills one cache line.
struct alignas(64) Proxy : btBroadphaseProxy {
  Proxy(const btVector3& lo, const btVector3& hi, void* client, int group, int mask)
      : btBroadphaseProxy(lo, hi, client, group, mask) {}

  Filter told;                        ///< what the World was told; users write the fields at any time
  ProxyId id;                         ///< null until the World has been told
  std::uint32_t position = 0;         ///< in the list of live proxies
  std::uint32_t letter_position = 0;  ///< see Letter
  bool dying = false;                 ///< destroyed while the World was busy
  bool is_ghost = false;              ///< what judged_client is
  const void* judged_client = nullptr;

  std::uint64_t created = 0;  ///< grows from proxy to proxy, also when unique ids start again

  // The list of its pairs: see PairLinks.
  std::uint64_t links_epoch = 0;
  std::uint32_t first_link = no_link;
  std::uint32_t degree = 0;

  Filter filter() const { return {std::uint32_t(m_collisionFilterGroup), std::uint32_t(m_collisionFilterMask)}; }
  bool has_new_filter() const {
    return told.group != std::uint32_t(m_collisionFilterGroup) || told.mask != std::uint32_t(m_collisionFilterMask);
  }
};

inline BasicAabb<btScalar> box_of(const btVector3& lo, const btVector3& hi) {
  return {{lo.x(), lo.y(), lo.z()}, {hi.x(), hi.y(), hi.z()}};
}

inline Proxy& proxy_of(const BasicWorld<btScalar>& world, ProxyId id) {
  return *reinterpret_cast<Proxy*>(world.user(id));
}

inline bool names_dying(const btBroadphasePair& pair) {
  return static_cast<const Proxy*>(pair.m_pProxy0)->dying || static_cast<const Proxy*>(pair.m_pProxy1)->dying;
}

/// Which one of the pairs that the World holds this is, if it is one.
inline std::optional<std::uint32_t> place_in(const BasicWorld<btScalar>& world, const btBroadphasePair& pair) {
  return world.pair_place(static_cast<const Proxy*>(pair.m_pProxy0)->id, static_cast<const Proxy*>(pair.m_pProxy1)->id);
}

inline std::uint64_t pair_key(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const auto x = std::uint32_t(a.m_uniqueId), y = std::uint32_t(b.m_uniqueId);
  return std::uint64_t(x < y ? x : y) << 32 | (x < y ? y : x);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
