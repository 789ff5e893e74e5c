// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <boxstream/bullet.hpp>

#include "pair_cache.hpp"
#include "precision.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

struct Broadphase::Impl {
  using Box = BasicAabb<btScalar>;

  Impl(btOverlappingPairCache* borrowed, const Options& given);
  ~Impl();

  // broadphase.cpp
  Proxy* create(const btVector3& lo, const btVector3& hi, void* client, int group, int mask);
  void destroy(Proxy& proxy, btDispatcher* dispatcher);
  void move(Proxy& proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher);
  void reset();

  // broadphase_pairs.cpp
  void update_pairs(btDispatcher* dispatcher);
  void begin_eagerly(Proxy& proxy, btDispatcher* dispatcher);

  /// What the World compares: the box grown by the margin, unless that could make an invalid box valid.
  Box world_box(const Proxy& proxy) const;
  Proxy& proxy_of(ProxyId id) const { return *reinterpret_cast<Proxy*>(world.user(id)); }

  const Options options;
  std::unique_ptr<PairCache> own;       ///< null if the cache is borrowed
  btOverlappingPairCache* const cache;  ///< own or borrowed
  const bool computes_pairs;
  BasicWorld<btScalar> world;
  std::vector<Proxy*> live;
  std::int32_t last_uid = 0;
  int borrowed_pairs =
      0;  ///< in a borrowed cache when it was last seen; another number later means that a user was there
  WorldStats stats;

  /// While callbacks may run that must not change proxies. If one does, what it did is done to the World afterwards,
  /// and a destroyed proxy's memory kept until then.
  bool world_is_busy = false;
  std::vector<Proxy*> late;

 private:
  class Busy;

  void tell_world(Proxy& proxy);
  bool postpone(Proxy& proxy);
  void catch_up();
  void forget(Proxy& proxy);

  bool default_rule_holds() const;
  bool accepts(ProxyId a, ProxyId b) const;
  void sync_filter(Proxy& proxy, bool default_rule);
  void learn_from_cache(btDispatcher* dispatcher);
  bool wants_eager(Proxy& proxy, btDispatcher* dispatcher) const;
  void find_events(btDispatcher* dispatcher);
  void deliver_events(btDispatcher* dispatcher);
  void end_in_borrowed(btDispatcher* dispatcher);

  std::vector<KeyedPair> begun;
  std::vector<KeyedPair> ended;    ///< of live proxies only
  std::vector<Proxy*> neighbours;  ///< scratch of begin_eagerly
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
