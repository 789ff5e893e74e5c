// SPDX-License-Identifier: MIT
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <boxstream/detail/float_environment.hpp>

#include "abi_check.hpp"
#include "borrowed_cache.hpp"
#include "broadphase_impl.hpp"
#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

Options checked(Options options) {
  const boxstream::detail::DefaultFloatEnvironment environment;
  if (!(options.margin >= std::numeric_limits<btScalar>::min())) options.margin = 0;
  return options;
}

WorldOptions world_options(const Options& options) {
  WorldOptions world;
  world.executor = options.executor;
  world.sticky_filters = true;
  world.method = options.method;
  world.cutoff = options.cutoff;
  return world;
}

using Bits = std::conditional_t<sizeof(btScalar) == 4, std::uint32_t, std::uint64_t>;

/// Compares scalar by scalar: callers have just written them so, and a wider load would stall on store forwarding.
bool has_same_bits(const btVector3& a, const btVector3& b) {
  const auto differ = [&](int d) { return std::bit_cast<Bits>(a.m_floats[d]) ^ std::bit_cast<Bits>(b.m_floats[d]); };
  return (differ(0) | differ(1) | differ(2)) == 0;
}

}  // namespace

Broadphase::Impl::Impl(btOverlappingPairCache* borrowed, const Options& given)
    : options(checked(given)),
      own(borrowed ? nullptr : new PairCache),
      cache(borrowed ? borrowed : own.get()),
      computes_pairs(!borrowed || keeps_pairs(*borrowed)),
      contact_reach(options.eager != Eager::none, options.margin),
      world(world_options(options)) {
  default_rule = is_rule_current = own != nullptr;
  if (borrowed) snapshot.capture(*borrowed);
}

Proxy* Broadphase::Impl::create(const btVector3& lo, const btVector3& hi, void* client, int group, int mask) {
  close_rooms();
  return or_fatal([&] {
    const std::int32_t id = ids.next(live);
    Proxy* const proxy = pool.make(lo, hi, client, group, mask);
    proxy->m_uniqueId = id;
    proxy->created = ++created;
    proxy->margin = options.margin;
    proxy->position = std::uint32_t(live.size());
    if (live.size() == live.capacity()) live.reserve(std::max<std::size_t>(2 * live.size(), 8));
    live.push_back(proxy);
    few_verdicts.note_created(*proxy, box_in_world(*proxy));
    pending.reserve(live.size());
    pending.create(*proxy);
    note_filter(filter_for_world(*proxy));
    note_pending();
    all_have_begun = false;
    if (surroundings.are_kept()) surroundings.note_created(*proxy, box_in_world(*proxy));
    return proxy;
  });
}

void Broadphase::Impl::destroy(Proxy& proxy, btDispatcher* dispatcher) {
  assert((!own || !own->is_in_callback()) && "callbacks for pairs must not destroy proxies");
  close_rooms();
  all_have_begun = is_quiet = false;
  end_all_of(proxy, dispatcher);
  few_verdicts.note_destroyed(proxy, live.size());
  live.back()->position = proxy.position;
  live[proxy.position] = live.back();
  live.pop_back();
  pending.discard(proxy);
  if (surroundings.are_kept()) surroundings.note_destroyed(proxy);
  proxy.destroyed = true;
  if (world_is_busy)
    or_fatal([&] { destroyed.push_back(&proxy); });
  else
    free_proxy(proxy);
}

/// Callbacks may begin none until it is gone.
void Broadphase::Impl::end_all_of(Proxy& proxy, btDispatcher* dispatcher) {
  struct Ending {
    explicit Ending(bool& is) : is_ending(is), was(std::exchange(is, true)) {}
    ~Ending() { is_ending = was; }
    bool& is_ending;
    const bool was;
  } const ending{is_ending};
  bool is_done = false;
  while (!is_done && may_end_by_few(dispatcher)) {
    const bool holds_any = few_verdicts.hold_any(proxy);
    release_in_world(proxy);
    few_verdicts.note_alone(proxy);
    if (holds_any) surroundings.forget_held();
    is_done = !holds_any || !own->end_all_of(proxy, dispatcher);  // users may have added some
  }
  if (is_done) return;
  few_verdicts.forget();
  if (own) return own->remove_all_of(proxy, dispatcher);
  cache->removeOverlappingPairsContainingProxy(&proxy, dispatcher);
  snapshot.remove_all_of(proxy);
}

/// True if verdicts say which pairs a proxy has, and it can be destroyed without the World.
bool Broadphase::Impl::may_end_by_few(btDispatcher* dispatcher) {
  if (!own || own->is_in_callback() || world_is_busy) return false;
  own->flush_notifications(dispatcher);
  constexpr std::uint32_t most_pairs = 2048;  // links of the cache find the pairs of one among more
  return few_verdicts.are_known() && own->holds_worlds_pairs() && own->store().size() <= most_pairs;
}

/// The pairs that the World holds, as verdicts know, of a proxy that is about to be destroyed.
void Broadphase::Impl::release_in_world(const Proxy& proxy) {
  or_fatal([&] {
    few_verdicts.for_each_in_world(live, proxy, [&](const Proxy& other) { world.release(proxy.id, other.id); });
  });
}

void Broadphase::Impl::move(Proxy& proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) {
  const bool has_reach = dispatcher && !options.exact_boxes;
  if (has_same_bits(proxy.m_aabbMin, lo) && has_same_bits(proxy.m_aabbMax, hi)) return;
  const bool is_eager = may_begin_eagerly(dispatcher);
  const Box settled = is_eager ? settled_box(proxy) : no_box;
  const btScalar margin = proxy.margin;
  if (has_reach) contact_reach.update(proxy, lo, hi);
  proxy.m_aabbMin = lo;
  proxy.m_aabbMax = hi;
  if (proxy.margin != margin || rooms.are_few()) close_rooms();
  if (rooms.are_open()) {
    rooms.note_exit(proxy);
    has_pending.store(true, std::memory_order_relaxed);
  } else {
    const Box box = box_in_world(proxy);
    pending.move(proxy, box);
    few_verdicts.note_move(proxy, box);
    if (surroundings.are_kept()) surroundings.note_move(proxy, box);
    note_pending();
  }
  if (is_eager)
    begin_eagerly(proxy, settled, dispatcher);
  else
    all_have_begun = false;
}

void Broadphase::Impl::reset() {
  if (!live.empty() || world_is_busy) return;
  close_rooms();
  or_fatal([&] {
    flush_pending();
    world = BasicWorld<btScalar>(world_options(options));
  });
  if (own) own->clear();
  ids.reset();
  pool.clear();
  pending = PendingChanges();
  rooms.give_back();
  rooms_choice = {};
  few_verdicts = {};
  world_lags = false;
  surroundings = {};
  std::vector<Proxy*>().swap(live);
  std::vector<Proxy*>().swap(destroyed);
  std::vector<btBroadphasePair>().swap(early);
  for (auto* pairs : {&begun, &ended}) std::vector<ProxyPair>().swap(*pairs);
  std::vector<Box>().swap(sampled);
  spare_lists.clear();
  default_rule = own != nullptr;
  stats = {};
  held_batches = few_failures = few_wait = still_batches = 0;
  next_checked = checked_since_change = answered = 0;
  groups = 0;
  shared_mask = ~std::uint32_t{0};
  is_rule_current = own != nullptr;
  known_callback = nullptr;
  known_filters_set = 0;
  may_refuse = has_new_filters = is_quiet = all_have_begun = false;
}

void Broadphase::Impl::shrink_to_fit() {
  if (world_is_busy) return;
  close_rooms();
  or_fatal([&] {
    flush_pending();
    world.shrink_to_fit();
    if (own) own->shrink_to_fit();
    live.shrink_to_fit();
    pending.shrink_to_fit(live.capacity());
  });
  few_verdicts.give_back();
  rooms.give_back();
  surroundings.forget();
  spare_lists.clear();
  std::vector<Proxy*>().swap(destroyed);
  std::vector<btBroadphasePair>().swap(early);
  for (auto* pairs : {&begun, &ended}) std::vector<ProxyPair>().swap(*pairs);
}

void Broadphase::Impl::flush_all_pending() {
  const std::lock_guard lock(flushing);
  flush_alone();
}

void Broadphase::Impl::flush_alone() {
  if (is_in_world || !has_pending.load(std::memory_order_relaxed)) return;
  pass_on_differing();
  flush_changes();
  has_pending.store(false, std::memory_order_release);
}

void Broadphase::Impl::flush_changes() {
  or_fatal([&] {
    pending.flush(world, [this](const Proxy& proxy) {
      const Filter filter = filter_for_world(proxy);
      note_filter(filter);
      if (proxy.has_new_filter()) few_verdicts.forget();
      return filter;
    });
  });
}

/// Releases its pairs first, so that the World holds none of a proxy that is gone.
void Broadphase::Impl::free_proxy(Proxy& proxy) {
  is_quiet = false;
  if (own)
    or_fatal([&] {
      if (!few_verdicts.are_known()) catch_up();  // else see release_in_world
      release_user_changes(nullptr, false);
    });
  if (proxy.id) world.destroy(proxy.id);
  pool.drop(proxy);
}

void Broadphase::Impl::free_destroyed() {
  for (Proxy* proxy : destroyed) free_proxy(*proxy);
  destroyed.clear();
}

Broadphase::Broadphase(btOverlappingPairCache* cache, Options options) {
  require_matching_precision();
  impl_ = or_fatal([&] { return std::make_unique<Impl>(cache, options); });
}

Broadphase::Broadphase(const Options& options) : Broadphase(nullptr, options) {}

Broadphase::~Broadphase() = default;

btBroadphaseProxy* Broadphase::createProxy(const btVector3& aabbMin, const btVector3& aabbMax, int, void* userPtr,
                                           int collisionFilterGroup, int collisionFilterMask,
                                           btDispatcher* dispatcher) {
  Proxy* const proxy = impl_->create(aabbMin, aabbMax, userPtr, collisionFilterGroup, collisionFilterMask);
  if (impl_->may_begin_eagerly(dispatcher)) impl_->begin_eagerly(*proxy, no_box, dispatcher);
  return proxy;
}

void Broadphase::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  impl_->destroy(static_cast<Proxy&>(*proxy), dispatcher);
}

void Broadphase::setAabb(btBroadphaseProxy* proxy, const btVector3& aabbMin, const btVector3& aabbMax,
                         btDispatcher* dispatcher) {
  Impl& impl = *impl_;
  Proxy& moved = static_cast<Proxy&>(*proxy);
  if (moved.has_new_filter()) impl.has_new_filters = true;
  const bool stays =
      impl.rooms.are_open() && impl.rooms.hold(moved, aabbMin, aabbMax) &&
      (!dispatcher || impl.options.exact_boxes || impl.contact_reach.is_current(moved, impl.rooms.shape(moved)));
  stays ? impl.move_in_room(moved, aabbMin, aabbMax, dispatcher) : impl.move(moved, aabbMin, aabbMax, dispatcher);
}

void Broadphase::getAabb(btBroadphaseProxy* proxy, btVector3& aabbMin, btVector3& aabbMax) const {
  aabbMin = proxy->m_aabbMin;
  aabbMax = proxy->m_aabbMax;
}

void Broadphase::calculateOverlappingPairs(btDispatcher* dispatcher) {
  impl_->update_pairs(dispatcher);
}

btOverlappingPairCache* Broadphase::getOverlappingPairCache() {
  return impl_->cache;
}

const btOverlappingPairCache* Broadphase::getOverlappingPairCache() const {
  return impl_->cache;
}

void Broadphase::getBroadphaseAabb(btVector3& aabbMin, btVector3& aabbMax) const {
  impl_->flush_pending();
  const auto bounds = or_fatal([&] { return impl_->world.bounds(); });
  const bool any = is_valid(bounds);
  aabbMin.setValue(any ? bounds.min[0] : 0, any ? bounds.min[1] : 0, any ? bounds.min[2] : 0);
  aabbMax.setValue(any ? bounds.max[0] : 0, any ? bounds.max[1] : 0, any ? bounds.max[2] : 0);
}

void Broadphase::resetPool(btDispatcher*) {
  impl_->reset();
}

void Broadphase::shrink_to_fit() {
  impl_->shrink_to_fit();
}

void Broadphase::refilter() {
  impl_->refilter();
}

void Broadphase::printStats() {}

const WorldStats& Broadphase::stats() const {
  return impl_->stats;
}

void Broadphase::validate() const {
  impl_->validate();
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
