// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include <BulletCollision/BroadphaseCollision/btBroadphaseProxy.h>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/world.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

inline constexpr std::uint32_t no_link = ~std::uint32_t{0};

/// A btBroadphaseProxy with the data of the adapter. In single precision, the fields that passes over all proxies read,
/// up to `room`, fill one cache line.
struct alignas(64) Proxy : btBroadphaseProxy {
  Proxy(const btVector3& lo, const btVector3& hi, void* client, int group, int mask)
      : btBroadphaseProxy(lo, hi, client, group, mask) {}

  Filter world_filter;              ///< in the World; users may write the fields of the base at any time
  std::uint32_t room = no_link;     ///< see ProxyRooms
  ProxyId id;                       ///< null until the first flush
  std::uint32_t position = 0;       ///< in the list of live proxies
  std::uint32_t pending_index = 0;  ///< see PendingChanges
  std::uint8_t moves_until_sized = 0;
  bool has_left_room = false;  ///< and the next: see ProxyRooms
  bool has_strayed = false;
  bool is_watched : 1 = false;    ///< in bits, so that there are two cache lines
  bool destroyed : 1 = false;     ///< its memory is freed once the World is not busy
  bool is_ghost : 1 = false;      ///< of checked_client
  btScalar margin = 0;            ///< by which its box is larger in the World: see ContactReach
  std::uint32_t row = 0;          ///< see Surroundings
  std::uint32_t links_epoch = 0;  ///< see PairLinks
  const void* checked_client = nullptr;
  const void* sized_shape = nullptr;

  std::uint64_t created = 0;  ///< grows from proxy to proxy, also when unique ids start again

  // The list of its pairs: see PairLinks.
  std::uint32_t first_link = no_link;
  std::uint32_t degree = 0;

  Filter filter() const { return {std::uint32_t(m_collisionFilterGroup), std::uint32_t(m_collisionFilterMask)}; }
  bool has_new_filter() const {
    return world_filter.group != std::uint32_t(m_collisionFilterGroup) ||
           world_filter.mask != std::uint32_t(m_collisionFilterMask);
  }
};

inline constexpr BasicAabb<btScalar> no_box{{1, 1, 1}, {-1, -1, -1}};

inline BasicAabb<btScalar> box_of(const btVector3& lo, const btVector3& hi) {
  return {{lo.x(), lo.y(), lo.z()}, {hi.x(), hi.y(), hi.z()}};
}

inline Proxy& proxy_of(const BasicWorld<btScalar>& world, ProxyId id) {
  return *reinterpret_cast<Proxy*>(world.user(id));
}

/// Null if it is not live.
inline Proxy* live_proxy_of(const BasicWorld<btScalar>& world, ProxyId id) {
  return reinterpret_cast<Proxy*>(world.user(id));
}

inline bool has_destroyed(const btBroadphasePair& pair) {
  return static_cast<const Proxy*>(pair.m_pProxy0)->destroyed || static_cast<const Proxy*>(pair.m_pProxy1)->destroyed;
}

/// The place of a pair among the pairs that the World holds, if it is one.
inline std::optional<std::uint32_t> place_in(const BasicWorld<btScalar>& world, const btBroadphasePair& pair) {
  return world.pair_place(static_cast<const Proxy*>(pair.m_pProxy0)->id, static_cast<const Proxy*>(pair.m_pProxy1)->id);
}

inline std::uint64_t pair_key(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  const auto x = std::uint32_t(a.m_uniqueId), y = std::uint32_t(b.m_uniqueId);
  return std::uint64_t(x < y ? x : y) << 32 | (x < y ? y : x);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
