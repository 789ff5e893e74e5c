// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cassert>
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
  /// `settled`: see BasicWorld::begin_pairs_of.
  void begin_eagerly(Proxy& proxy, const Box& settled, btDispatcher* dispatcher);
  static constexpr Box no_box{{1, 1, 1}, {-1, -1, -1}};
  /// The box of a proxy all of whose pairs have been asked about. Only if all boxes are eager: with another one that
  /// has moved into this box since, it may not have been.
  Box settled_box(const Proxy& proxy) const {
    if (options.eager != Eager::all || !proxy.id) return no_box;
    return Letter::grown(box_of(proxy.m_aabbMin, proxy.m_aabbMax), options.margin);
  }
  /// False if no proxy could get pairs before the next batch. Only a ghost callback could see the difference, and it
  /// casts clients as we do. A borrowed cache does not tell whether it has one; but a ghost's pairs are of no use
  /// without a dispatcher.
  bool may_begin_eagerly(const btDispatcher* dispatcher) const {
    if (options.eager == Eager::ghosts) return own ? own->has_ghost_callback() : dispatcher != nullptr;
    return options.eager == Eager::all;
  }

  Proxy& proxy_of(ProxyId id) const { return bullet::proxy_of(world, id); }

  const Options options;
  std::unique_ptr<PairCache> own;       ///< null if the cache is borrowed
  btOverlappingPairCache* const cache;  ///< own or borrowed
  const bool computes_pairs;
  BasicWorld<btScalar> world;
  ProxyPool pool;
  std::vector<Proxy*> live;
  mutable SpareLists spare_lists;
  UniqueIds ids;
  std::uint64_t created = 0;  ///< proxies, ever
  CacheMirror mirror;         ///< of a borrowed cache
  WorldStats stats;

  /// While callbacks may run that must not change proxies. If one does, the World is told afterwards, and a destroyed
  /// proxy's memory kept until then.
  bool world_is_busy = false;

 private:
  class Busy;

  void tell_all();
  void note_untold() {
    assert(!world_is_busy && "callbacks for pairs must not create, change or destroy proxies");
    has_untold.store(true, std::memory_order_relaxed);
  }
  void forget(Proxy& proxy);
  void bury_the_dying();

  Filter filter_for_world(const Proxy& proxy) const {
    constexpr std::uint32_t all = ~std::uint32_t{0};
    return default_rule ? proxy.filter() : Filter{all, all};
  }
  bool accepts(ProxyId a, ProxyId b) const;
  void sync_rule();
  void sync_filters();
  void tell_filter(Proxy& proxy, Filter filter);
  void learn_from_cache(btDispatcher* dispatcher, bool thoroughly);
  bool wants_eager(Proxy& proxy) const;
  void find_events(btDispatcher* dispatcher);
  void end_in_borrowed(btDispatcher* dispatcher);

  /// Bullet's default rule runs inside the World, unless a filter callback replaces it. A borrowed cache may be of a
  /// class that overrides it.
  bool default_rule = false;
  bool is_rule_told = false;
  btOverlapFilterCallback* told_callback = nullptr;
  unsigned told_filters_set = 0;

  // Users write groups and masks at any time. It shows when the box of the proxy is set; of the others, some are looked
  // at in each batch, in turn.
  bool has_new_filters = false;
  std::size_t looked_at = 0;  ///< of the live ones, in this turn

  Letter letter;
  std::atomic<bool> has_untold{false};
  std::mutex telling;

  std::vector<Proxy*> dying;  ///< destroyed while the World was busy

  std::vector<btBroadphasePair> early;  ///< scratch of begin_eagerly
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
