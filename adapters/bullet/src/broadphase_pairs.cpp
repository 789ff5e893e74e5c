// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>

#include "borrowed_cache.hpp"
#include "broadphase_impl.hpp"
#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

namespace {

bool is_ghost(const void* client) {
  // Callers without collision objects often pass an index as client.
  constexpr std::uintptr_t lowest_address = 65536;
  const auto address = reinterpret_cast<std::uintptr_t>(client);
  if (address < lowest_address || address % alignof(btCollisionObject) != 0) return false;
  return static_cast<const btCollisionObject*>(client)->getInternalType() == btCollisionObject::CO_GHOST_OBJECT;
}

}  // namespace

/// The World is busy while one of these lives.
class Broadphase::Impl::Busy {
 public:
  explicit Busy(Impl& impl) : impl_(impl) { impl_.world_is_busy = true; }
  ~Busy() { impl_.world_is_busy = false; }

 private:
  Impl& impl_;
};

bool Broadphase::Impl::accepts(ProxyId a, ProxyId b) const {
  Proxy& low = proxy_of(a);
  Proxy& high = proxy_of(b);
  if (low.dying || high.dying) return false;
  if (own) {
    if (own->needsBroadphaseCollision(&low, &high)) return true;
    // That the filter was written shows from now on, whether the World has been told or not.
    for (Proxy* proxy : {&low, &high}) proxy->told = proxy->filter();
    return false;
  }
  // Adding is asking: the cache calls its filter once for each pair.
  require_room(*cache, 1);
  const int before = cache->getNumOverlappingPairs();
  const bool added = cache->addOverlappingPair(&low, &high) || cache->getNumOverlappingPairs() != before;
  if (!low.dying && !high.dying) return added;
  // The filter destroyed one of the two and then said yes.
  cache->removeOverlappingPair(&low, &high, nullptr);
  return false;
}

/// A filter callback that was set may answer otherwise than the one before.
void Broadphase::Impl::sync_rule() {
  btOverlapFilterCallback* const callback = cache->getOverlapFilterCallback();
  const unsigned filters_set = own ? own->filters_set() : 0;
  if (is_rule_told && callback == told_callback && filters_set == told_filters_set) return;
  default_rule = own && !callback;
  for (Proxy* proxy : live) tell_filter(*proxy, proxy->filter());
  is_rule_told = true;
  told_callback = callback;
  told_filters_set = filters_set;
}

/// Tells the World where users have written groups and masks.
void Broadphase::Impl::sync_filters() {
  constexpr std::size_t least_looked_at = 128, turns = 16;
  const auto is_new = [](const Proxy* proxy) { return proxy->has_new_filter(); };
  if (!has_new_filters) {
    const std::size_t width = std::max(least_looked_at, live.size() / turns);
    if (looked_at >= live.size() || width >= live.size()) looked_at = 0;
    const auto first = live.begin() + std::ptrdiff_t(looked_at);
    looked_at = std::min(live.size(), looked_at + width);
    if (std::none_of(first, live.begin() + std::ptrdiff_t(looked_at), is_new)) return;
  }
  for (Proxy* proxy : live)
    if (is_new(proxy)) tell_filter(*proxy, proxy->filter());
  has_new_filters = false;
}

void Broadphase::Impl::tell_filter(Proxy& proxy, Filter filter) {
  proxy.told = filter;
  world.set_filter(proxy.id, filter_for_world(proxy));
  world.ask_again(proxy.id);
}

/// If not `thoroughly`, which takes a pass over all pairs, what a user exchanged in a borrowed cache may go unnoticed.
void Broadphase::Impl::learn_from_cache(btDispatcher* dispatcher, bool thoroughly) {
  if (own) return own->user_changes().tell([this](ProxyId a, ProxyId b) { world.release(a, b); });
  if (thoroughly || std::size_t(cache->getNumOverlappingPairs()) != mirror.size())
    reconcile(*cache, mirror, world, dispatcher);
}

void Broadphase::Impl::update_pairs(btDispatcher* dispatcher) {
  if (!computes_pairs || world_is_busy) return;
  if (own) own->deliver(dispatcher);
  or_fatal([&] { find_events(dispatcher); });
  own ? own->deliver(dispatcher) : end_in_borrowed(dispatcher);
}

void Broadphase::Impl::find_events(btDispatcher* dispatcher) {
  tell_world();
  learn_from_cache(dispatcher, true);
  sync_rule();
  sync_filters();
  if (own) own->prepare(world);
  {
    const Busy busy(*this);
    stats = world.update([&](ProxyId a, ProxyId b) { return accepts(a, b); });
  }
  if (own) {
    own->follow(world);
    bury_the_dying();
  }
}

/// What began is in the cache already: see accepts.
void Broadphase::Impl::end_in_borrowed(btDispatcher* dispatcher) {
  if (!world.changes().empty()) {
    const Busy busy(*this);
    if (cache->hasDeferredRemoval()) {
      remove_deferred(*cache, world, dispatcher);
    } else {
      // Destroyed proxies have taken their pairs out of the cache already.
      for (const ProxyPair& pair : world.ended())
        if (world.contains(pair.a) && world.contains(pair.b) && !proxy_of(pair.a).dying && !proxy_of(pair.b).dying)
          cache->removeOverlappingPair(&proxy_of(pair.a), &proxy_of(pair.b), dispatcher);
    }
  }
  or_fatal([&] {
    const bool only_grew = world.ended().empty() && !cache->hasDeferredRemoval();  // otherwise pairs changed places
    if (!world.changes().empty()) only_grew ? mirror.take_end(*cache) : mirror.take(*cache);
    bury_the_dying();
  });
}

bool Broadphase::Impl::wants_eager(Proxy& proxy) const {
  if (options.eager == Eager::all) return true;
  if (proxy.m_clientObject != proxy.judged_client) {
    proxy.judged_client = proxy.m_clientObject;
    proxy.is_ghost = is_ghost(proxy.m_clientObject);
  }
  return proxy.is_ghost;
}

void Broadphase::Impl::begin_eagerly(Proxy& proxy, const Box& settled, btDispatcher* dispatcher) {
  if (!computes_pairs || world_is_busy || !wants_eager(proxy)) return;
  early.clear();
  or_fatal([&] {
    tell_world();
    learn_from_cache(dispatcher, false);
    const Busy busy(*this);
    try {
      world.begin_pairs_of(
          proxy.id, [&](ProxyId a, ProxyId b) { return accepts(a, b); },
          [&](ProxyPair pair) { early.emplace_back(proxy_of(pair.a), proxy_of(pair.b)); }, true, settled);
    } catch (...) {
      // A filter that throws must not leave pairs that the cache will never hear of: the next batch finds them again.
      for (const btBroadphasePair& pair : early)
        world.release(static_cast<Proxy*>(pair.m_pProxy0)->id, static_cast<Proxy*>(pair.m_pProxy1)->id);
      throw;
    }
  });
  if (own) {
    const Busy busy(*this);
    own->begin_early(early, dispatcher);
  } else {
    or_fatal([&] { mirror.take_end(*cache); });
  }
  or_fatal([&] { bury_the_dying(); });
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
