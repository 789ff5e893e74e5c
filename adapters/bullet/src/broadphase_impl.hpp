// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <boxstream/bullet.hpp>
#include <boxstream/detail/float_environment.hpp>

#include "cache_mirror.hpp"
#include "found.hpp"
#include "letter.hpp"
#include "pair_cache.hpp"
#include "precision.hpp"
#include "proxy.hpp"
#include "proxy_pool.hpp"
#include "unique_ids.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

struct Broadphase::Impl {
  using Box = BasicAabb<btScalar>;

  Impl(btOverlappingPairCache* borrowed, const Options& given);

  // broadphase.cpp
  Proxy* create(const btVector3& lo, const btVector3& hi, void* client, int group, int mask);
  void destroy(Proxy& proxy, btDispatcher* dispatcher);
  void move(Proxy& proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher);
  void reset();
  /// The next batch asks the filter again about all pairs that it refused.
  void refilter() { is_rule_told = false; }
  void validate() const;

  /// Passes on to the World what happened to boxes since the last call. Comes before everything that asks the World;
  /// queries may call it from several threads at once. While the World is busy it does nothing.
  void tell_world() {
    if (has_untold.load(std::memory_order_acquire)) tell_all();
  }

  // broadphase_pairs.cpp
  void update_pairs(btDispatcher* dispatcher);
  void begin_eagerly(Proxy& proxy, btDispatcher* dispatcher);
  /// False if no proxy could get pairs before the next batch. Only a ghost callback could see the difference, and it
  /// casts clients as we do. A borrowed cache does not tell whether it has one; but a ghost's pairs are of no use
  /// without a dispatcher.
  bool may_begin_eagerly(const btDispatcher* dispatcher) const {
    if (options.eager == Eager::ghosts) return own ? own->has_ghost_callback() : dispatcher != nullptr;
    return options.eager == Eager::all;
  }

  /// What the World compares: the box grown by the margin, unless that could make an invalid box valid.
  Box world_box(const Proxy& proxy) const {
    const Box box = box_of(proxy.m_aabbMin, proxy.m_aabbMax);
    if (options.margin == 0) return box;
    const boxstream::detail::DefaultFloatEnvironment environment;
    return is_valid(box) ? expanded(box, options.margin) : box;
  }
  Proxy& proxy_of(ProxyId id) const { return *reinterpret_cast<Proxy*>(world.user(id)); }

  const Options options;
  std::unique_ptr<PairCache> own;       ///< null if the cache is borrowed
  btOverlappingPairCache* const cache;  ///< own or borrowed
  const bool computes_pairs;
  BasicWorld<btScalar> world;
  ProxyPool pool;
  std::vector<Proxy*> live;
  mutable SpareLists spare_lists;
  UniqueIds ids;
  CacheMirror mirror;  ///< of a borrowed cache
  WorldStats stats;

  /// While callbacks may run that must not change proxies. If one does, the World is told afterwards, and a destroyed
  /// proxy's memory kept until then.
  bool world_is_busy = false;

 private:
  class Busy;

  void tell_all();
  void note(Proxy& proxy);
  void forget(Proxy& proxy);
  void bury_the_dying();

  static Filter filter_of(const Proxy& proxy) {
    return {std::uint32_t(proxy.m_collisionFilterGroup), std::uint32_t(proxy.m_collisionFilterMask)};
  }
  Filter filter_for_world(const Proxy& proxy) const {
    constexpr std::uint32_t all = ~std::uint32_t{0};
    return default_rule ? filter_of(proxy) : Filter{all, all};
  }
  bool accepts(ProxyId a, ProxyId b) const;
  void sync_rule();
  /// Tells the World if a user has written the proxy's group or mask.
  void sync_filter(Proxy& proxy) {
    const Filter now = filter_of(proxy);
    if (now.group != proxy.told.group || now.mask != proxy.told.mask) tell_filter(proxy, now);
  }
  void tell_filter(Proxy& proxy, Filter filter);
  void learn_from_cache(btDispatcher* dispatcher, bool thoroughly);
  bool wants_eager(Proxy& proxy) const;
  void find_events(btDispatcher* dispatcher);
  void deliver_events(btDispatcher* dispatcher);
  void end_in_borrowed(btDispatcher* dispatcher);

  /// Bullet's default rule runs inside the World, unless a filter callback replaces it. A borrowed cache may be of a
  /// class that overrides it.
  bool default_rule = false;
  bool is_rule_told = false;
  btOverlapFilterCallback* told_callback = nullptr;
  unsigned told_filters_set = 0;

  // Proxies that were created, or got another box, since the World was told. Boxes are collected so that many calls of
  // setAabb cost the World one; null where a proxy was destroyed since.
  std::vector<Proxy*> untold;
  std::atomic<bool> has_untold{false};
  std::mutex telling;
  Letter letter;  ///< scratch of tell_all

  std::vector<Proxy*> dying;  ///< destroyed while the World was busy

  std::vector<KeyedPair> begun;
  std::vector<KeyedPair> ended;  ///< of live proxies only
  std::vector<KeyedPair> early;  ///< scratch of begin_eagerly
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
