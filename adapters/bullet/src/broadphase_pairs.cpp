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

bool names_dying(const btBroadphasePair& pair) {
  return static_cast<const Proxy*>(pair.m_pProxy0)->dying || static_cast<const Proxy*>(pair.m_pProxy1)->dying;
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
  if (own) return own->needsBroadphaseCollision(&low, &high);
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
  for (Proxy* proxy : live) tell_filter(*proxy, filter_of(*proxy));
  is_rule_told = true;
  told_callback = callback;
  told_filters_set = filters_set;
}

void Broadphase::Impl::tell_filter(Proxy& proxy, Filter filter) {
  proxy.told = filter;
  world.set_filter(proxy.id, filter_for_world(proxy));
  world.ask_again(proxy.id);
}

/// If not `thoroughly`, which takes a pass over all pairs, what a user exchanged in a borrowed cache may go unnoticed.
void Broadphase::Impl::learn_from_cache(btDispatcher* dispatcher, bool thoroughly) {
  if (!own) {
    if (thoroughly || std::size_t(cache->getNumOverlappingPairs()) != mirror.size())
      reconcile(*cache, mirror, world, dispatcher);
    return;
  }
  const auto forget = [this](ProxyId a, ProxyId b) { world.release(a, b); };
  if (thoroughly)
    own->user_changes().begin_batch(forget);
  else
    own->user_changes().tell_new(forget);
}

void Broadphase::Impl::update_pairs(btDispatcher* dispatcher) {
  if (!computes_pairs || world_is_busy) return;
  or_fatal([&] { find_events(dispatcher); });
  deliver_events(dispatcher);
}

void Broadphase::Impl::find_events(btDispatcher* dispatcher) {
  tell_world();
  learn_from_cache(dispatcher, true);
  sync_rule();
  for (Proxy* proxy : live) sync_filter(*proxy);
  {
    const Busy busy(*this);
    stats = default_rule ? world.update() : world.update([&](ProxyId a, ProxyId b) { return accepts(a, b); });
  }
  const auto add = [&](ProxyPair pair, std::vector<KeyedPair>& events) {
    events.emplace_back(proxy_of(pair.a), proxy_of(pair.b));
    if (names_dying(events.back().pair)) events.pop_back();
  };
  begun.clear();
  for (const ProxyPair& pair : world.begun()) add(pair, begun);
  ended.clear();
  // Destroyed proxies have taken their pairs out of the cache already.
  for (const ProxyPair& pair : world.ended())
    if (world.contains(pair.a) && world.contains(pair.b)) add(pair, ended);
  if (!ids.grow_with_time()) {
    std::sort(begun.begin(), begun.end());
    std::sort(ended.begin(), ended.end());
  }
  bury_the_dying();
}

void Broadphase::Impl::deliver_events(btDispatcher* dispatcher) {
  if (own) {
    own->apply_batch(begun, ended, dispatcher);
  } else {
    if (begun.empty() && ended.empty()) return;
    end_in_borrowed(dispatcher);
    const bool only_grew = ended.empty() && !cache->hasDeferredRemoval();  // otherwise pairs changed places
    or_fatal([&] { only_grew ? mirror.take_end(*cache) : mirror.take(*cache); });
  }
}

/// What began is in the cache already: see accepts.
void Broadphase::Impl::end_in_borrowed(btDispatcher* dispatcher) {
  {
    const Busy busy(*this);
    if (cache->hasDeferredRemoval()) {
      remove_deferred(*cache, world, dispatcher);
    } else {
      for (const KeyedPair& pair : ended)
        if (!names_dying(pair.pair)) cache->removeOverlappingPair(pair.pair.m_pProxy0, pair.pair.m_pProxy1, dispatcher);
    }
  }
  or_fatal([&] { bury_the_dying(); });
}

bool Broadphase::Impl::wants_eager(Proxy& proxy) const {
  if (options.eager == Eager::all) return true;
  if (proxy.m_clientObject != proxy.judged_client) {
    proxy.judged_client = proxy.m_clientObject;
    proxy.is_ghost = is_ghost(proxy.m_clientObject);
  }
  return proxy.is_ghost;
}

void Broadphase::Impl::begin_eagerly(Proxy& proxy, btDispatcher* dispatcher) {
  if (!computes_pairs || world_is_busy || !wants_eager(proxy)) return;
  early.clear();
  or_fatal([&] {
    tell_world();
    learn_from_cache(dispatcher, false);
    const Busy busy(*this);
    try {
      world.begin_pairs_of(
          proxy.id, [&](ProxyId a, ProxyId b) { return accepts(a, b); },
          [&](ProxyPair pair) { early.emplace_back(proxy_of(pair.a), proxy_of(pair.b)); }, true);
    } catch (...) {
      // A filter that throws must not leave pairs that the cache will never hear of: the next batch finds them again.
      for (const KeyedPair& pair : early)
        world.release(static_cast<Proxy*>(pair.pair.m_pProxy0)->id, static_cast<Proxy*>(pair.pair.m_pProxy1)->id);
      throw;
    }
    std::sort(early.begin(), early.end());
  });
  if (own) {
    const Busy busy(*this);
    std::erase_if(early, [](const KeyedPair& pair) { return names_dying(pair.pair); });
    own->begin_early(early, dispatcher);
  } else {
    or_fatal([&] { mirror.take_end(*cache); });
  }
  or_fatal([&] { bury_the_dying(); });
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
