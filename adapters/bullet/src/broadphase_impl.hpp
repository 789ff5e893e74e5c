// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cassert>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <boxstream/bullet.hpp>
#include <boxstream/bullet/precision.hpp>
#include <boxstream/detail/float_environment.hpp>

#include "cache_snapshot.hpp"
#include "contact_reach.hpp"
#include "few_verdicts.hpp"
#include "found.hpp"
#include "pair_cache.hpp"
#include "pending_changes.hpp"
#include "proxy.hpp"
#include "proxy_pool.hpp"
#include "proxy_rooms.hpp"
#include "surroundings.hpp"
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
  /// The same for a box that is in its room.
  void move_in_room(Proxy& proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) {
    proxy.m_aabbMin = lo;
    proxy.m_aabbMax = hi;
    rooms.note_move(proxy);
    has_pending.store(true, std::memory_order_relaxed);
    if (may_begin_eagerly(dispatcher) && (proxy.is_watched || rooms.have_exits()))
      begin_eagerly(proxy, no_box, dispatcher);
  }
  void reset();
  void shrink_to_fit();
  /// The next batch asks the filter again about all pairs that it refused.
  void refilter() { is_rule_current = is_quiet = false; }
  void validate();

  /// Passes pending changes on to the World. Needed before every use of the World. Queries may call it on several
  /// threads at once. Does nothing within a call of the World.
  void flush_pending() {
    if (has_pending.load(std::memory_order_acquire)) flush_all_pending();
  }

  // broadphase_pairs.cpp
  void update_pairs(btDispatcher* dispatcher);

  // broadphase_eager.cpp
  /// `settled`: see BasicWorld::begin_pairs_of.
  void begin_eagerly(Proxy& proxy, const Box& settled, btDispatcher* dispatcher);
  /// The present box of a proxy: all its pairs there have begun or been refused. Only if all boxes are eager; otherwise
  /// another proxy may have moved into it since.
  Box settled_box(const Proxy& proxy) const {
    if (options.eager != Eager::all || !proxy.id) return no_box;
    return box_in_world(proxy);
  }
  bool is_exact_in_world(const Proxy& proxy) const { return proxy.margin == 0; }
  /// False if no proxy needs pairs before the next batch. Only a ghost callback could see the difference, and it casts
  /// clients in the same way. A borrowed cache does not say whether it has one; but a ghost's pairs need a dispatcher.
  bool may_begin_eagerly(const btDispatcher* dispatcher) const {
    if (options.eager == Eager::ghosts) return own ? own->has_ghost_callback() : dispatcher != nullptr;
    return options.eager == Eager::all;
  }

  Proxy& proxy_of(ProxyId id) const { return bullet::proxy_of(world, id); }

  const Options options;
  std::unique_ptr<PairCache> own;       ///< null if the cache is borrowed
  btOverlappingPairCache* const cache;  ///< own or borrowed
  const bool computes_pairs;
  const ContactReach contact_reach;
  BasicWorld<btScalar> world;
  ProxyPool pool;
  std::vector<Proxy*> live;
  mutable SpareLists spare_lists;
  UniqueIds ids;
  std::uint64_t created = 0;  ///< proxies, ever
  CacheSnapshot snapshot;     ///< of a borrowed cache
  WorldStats stats;

  ProxyRooms rooms;
  FewVerdicts few_verdicts;
  /// Verdicts have changed pairs, of which the World has to be told. Then neither rooms nor surroundings are kept.
  bool world_lags = false;
  Surroundings surroundings;
  mutable bool has_new_filters = false;

  /// True while callbacks may run that must not change proxies. If one does, the World gets the change from the next
  /// query or batch, and the memory of a destroyed proxy is freed afterwards.
  bool world_is_busy = false;
  /// True while they run within a call of the World, which can take no changes then.
  bool is_in_world = false;
  /// True while the pairs of a proxy that is destroyed end. Callbacks may change proxies, but no pair begins.
  bool is_ending = false;

 private:
  class Busy;
  class InWorld;

  void flush_all_pending();
  /// While nothing else uses the broad-phase.
  void flush_alone();
  void flush_changes();
  void note_pending() {
    assert(!world_is_busy && "callbacks for pairs must not create, change or destroy proxies");
    has_pending.store(true, std::memory_order_relaxed);
    is_quiet = false;
  }
  void free_proxy(Proxy& proxy);
  void free_destroyed();

  Filter filter_for_world(const Proxy& proxy) const {
    constexpr std::uint32_t all = ~std::uint32_t{0};
    return default_rule ? proxy.filter() : Filter{all, all};
  }
  bool is_still_quiet();
  bool is_done_by_few(btDispatcher* dispatcher);
  void catch_up();
  void find_untold();
  void end_all_of(Proxy& proxy, btDispatcher* dispatcher);
  bool may_end_by_few(btDispatcher* dispatcher);
  void release_in_world(const Proxy& proxy);
  bool is_rule_known() const;
  bool has_written_filter(std::size_t count);
  bool has_written_filter_in_quiet();

  // broadphase_eager.cpp
  bool wants_eager(Proxy& proxy) const;
  bool begin_among_candidates(Proxy& proxy);
  void keep_surroundings();
  void begin_among_neighbours(Proxy& proxy, const Box& settled);
  void begin_by_search(Proxy& proxy, const Box& settled);
  bool begin_found(Proxy& proxy);
  void release_early(std::size_t count);
  bool can_only_end();
  void find_ended();

  // broadphase_rooms.cpp
  /// What rooms say about a batch: that nothing changes; which pairs begin and end; or they are closed.
  enum class RoomsAnswer { nothing, pairs, unknown };
  RoomsAnswer ask_rooms();
  const std::vector<Proxy*>& with_rooms() const { return rooms.are_few() ? rooms.few() : live; }
  void pass_on_differing();
  void close_rooms();
  /// After a batch.
  void follow_rooms();
  bool is_calm();
  RoomsChoice::Price price_of_search() const { return room_prices::search(live.size()); }
  void note_filter(Filter filter) {
    groups |= filter.group;
    shared_mask &= filter.mask;
    may_refuse = may_refuse || filter.group == 0 || (groups & ~shared_mask) != 0;
  }
  bool accepts(ProxyId a, ProxyId b) const;
  void note_refusal(Proxy& low, Proxy& high) const;
  void update_rule();
  void update_filters();
  void update_filter(Proxy& proxy, Filter filter);
  void release_user_changes(btDispatcher* dispatcher, bool thoroughly);
  void find_events(btDispatcher* dispatcher);
  void ask_about_begun();
  void tell(Span<const ProxyPair> begin, Span<const ProxyPair> end);
  void note_ended();
  void end_in_borrowed(btDispatcher* dispatcher);

  /// True if the World applies Bullet's default rule: no filter callback replaces it. Never for a borrowed cache, whose
  /// class may override it.
  bool default_rule = false;
  bool is_rule_current = false;
  btOverlapFilterCallback* known_callback = nullptr;
  unsigned known_filters_set = 0;

  // Users may write group and mask fields at any time. Such a change is noticed when the box of the proxy is set; each
  // batch also checks some proxies, in rotation: fewer once all were checked since anything has changed, and none while
  // no pair can have been refused, for then it is early enough when a pair would begin.
  mutable bool may_refuse = false;
  std::uint32_t groups = 0, shared_mask = ~std::uint32_t{0};  ///< of all filters that the World has been told
  static constexpr std::size_t checked_if_few = 128, checked_in_batch = 64, checked_in_quiet = 16;
  std::size_t count_to_check() const { return live.size() <= checked_if_few ? checked_if_few : checked_in_batch; }
  std::size_t next_checked = 0;          ///< of the live proxies
  std::size_t checked_since_change = 0;  ///< in quiet batches

  // Of rooms.
  RoomsChoice rooms_choice;                 ///< about those of all proxies
  unsigned held_batches = 0;                ///< that the present rooms have lasted
  unsigned few_failures = 0, few_wait = 0;  ///< of rooms of some proxies, and batches before the next try
  std::vector<Box> sampled;                 ///< of some proxies, before the last of the calm batches

  bool is_quiet = false;       ///< the last batches have changed nothing, and nothing has changed since
  unsigned still_batches = 0;  ///< that have changed nothing, in a row

  PendingChanges pending;
  std::atomic<bool> has_pending{false};
  std::mutex flushing;

  std::vector<Proxy*> destroyed;  ///< destroyed while the World was busy

  std::vector<btBroadphasePair> early;  ///< scratch of begin_eagerly
  std::vector<ProxyPair> begun, ended;  ///< scratch of find_events

  /// All that changed since the last batch are boxes of proxies whose pairs began within their moves.
  bool all_have_begun = false;
  std::size_t answered = 0;  ///< of these moves
};

/// The World is busy while one of these lives.
class Broadphase::Impl::Busy {
 public:
  explicit Busy(Impl& impl) : impl_(impl) { impl_.world_is_busy = true; }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;
  ~Busy() { impl_.world_is_busy = false; }

 protected:
  Impl& impl_;
};

/// The same, within a call of the World.
class Broadphase::Impl::InWorld : Busy {
 public:
  explicit InWorld(Impl& impl) : Busy(impl) { impl_.is_in_world = true; }
  ~InWorld() { impl_.is_in_world = false; }
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
