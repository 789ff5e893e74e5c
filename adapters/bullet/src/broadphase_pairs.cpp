// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <optional>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <LinearMath/btQuickprof.h>

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

/// Bullet's default rule runs inside the World, unless a filter callback replaces it. A borrowed cache may be of a
/// class that overrides it.
bool Broadphase::Impl::default_rule_holds() const {
  return own && !own->getOverlapFilterCallback();
}

bool Broadphase::Impl::accepts(ProxyId a, ProxyId b) const {
  Proxy& low = proxy_of(a);
  Proxy& high = proxy_of(b);
  return !low.dying && !high.dying && cache->needsBroadphaseCollision(&low, &high);
}

void Broadphase::Impl::sync_filter(Proxy& proxy, bool default_rule) {
  constexpr std::uint32_t all = ~std::uint32_t{0};
  const Filter live_bits{std::uint32_t(proxy.m_collisionFilterGroup), std::uint32_t(proxy.m_collisionFilterMask)};
  const Filter now = default_rule ? live_bits : Filter{all, all};
  if (now.group == proxy.told.group && now.mask == proxy.told.mask) return;
  proxy.told = now;
  if (proxy.id) world.set_filter(proxy.id, now);
}

void Broadphase::Impl::learn_from_cache(btDispatcher* dispatcher) {
  if (!own) {
    if (cache->getNumOverlappingPairs() != borrowed_pairs) reconcile(*cache, world, dispatcher);
    borrowed_pairs = cache->getNumOverlappingPairs();
    return;
  }
  for (const ProxyPair& pair : own->removed_by_users()) world.release(pair.a, pair.b);
  own->removed_by_users().clear();
}

void Broadphase::Impl::update_pairs(btDispatcher* dispatcher) {
  BT_PROFILE("boxstream::calculateOverlappingPairs");
  if (!computes_pairs || world_is_busy) return;
  or_fatal([&] { find_events(dispatcher); });
  deliver_events(dispatcher);
}

void Broadphase::Impl::find_events(btDispatcher* dispatcher) {
  BT_PROFILE("boxstream::findPairs");
  learn_from_cache(dispatcher);
  const bool default_rule = default_rule_holds();
  for (Proxy* proxy : live) sync_filter(*proxy, default_rule);
  if (own && !default_rule) {
    const Busy busy(*this);
    stats = world.update([&](ProxyId a, ProxyId b) { return accepts(a, b); });
  } else {
    stats = world.update();
  }
  const auto note = [&](ProxyPair pair, std::vector<KeyedPair>& events) {
    Proxy& low = proxy_of(pair.a);
    Proxy& high = proxy_of(pair.b);
    if (!low.dying && !high.dying) events.emplace_back(low, high);
  };
  begun.clear();
  for (const ProxyPair& pair : world.begun()) note(pair, begun);
  ended.clear();
  // Destroyed proxies have taken their pairs out of the cache already.
  for (const ProxyPair& pair : world.ended())
    if (world.contains(pair.a) && world.contains(pair.b)) note(pair, ended);
  catch_up();
}

void Broadphase::Impl::deliver_events(btDispatcher* dispatcher) {
  BT_PROFILE("boxstream::updatePairCache");
  if (own) {
    own->apply_batch(begun, ended, dispatcher);
  } else if (!begun.empty() || !ended.empty()) {
    deliver_to_borrowed(dispatcher);
    borrowed_pairs = cache->getNumOverlappingPairs();
  }
}

void Broadphase::Impl::deliver_to_borrowed(btDispatcher* dispatcher) {
  if (cache->hasDeferredRemoval()) {
    add_to_borrowed(begun);
    or_fatal([&] { remove_deferred(*cache, world, dispatcher); });
    return;
  }
  for (const KeyedPair& pair : ended)
    cache->removeOverlappingPair(pair.pair.m_pProxy0, pair.pair.m_pProxy1, dispatcher);
  add_to_borrowed(begun);
}

/// The cache asks its own filter, once for each pair; the World forgets what it refuses, and so offers it again.
void Broadphase::Impl::add_to_borrowed(const std::vector<KeyedPair>& pairs) {
  require_room(*cache, pairs.size());
  for (const KeyedPair& pair : pairs) {
    auto& low = static_cast<Proxy&>(*pair.pair.m_pProxy0);
    auto& high = static_cast<Proxy&>(*pair.pair.m_pProxy1);
    const int before = cache->getNumOverlappingPairs();
    if (!cache->addOverlappingPair(&low, &high) && cache->getNumOverlappingPairs() == before)
      or_fatal([&] { world.release(low.id, high.id); });
  }
}

bool Broadphase::Impl::wants_eager(Proxy& proxy, btDispatcher* dispatcher) const {
  if (options.eager != Eager::ghosts) return options.eager == Eager::all;
  // Only a ghost callback could see the difference, and it makes the same cast. A borrowed cache does not tell whether
  // it has one; but a ghost's pairs are of no use without a dispatcher.
  if (own ? !own->has_ghost_callback() : !dispatcher) return false;
  if (proxy.m_clientObject != proxy.judged_client) {
    proxy.judged_client = proxy.m_clientObject;
    proxy.is_ghost = is_ghost(proxy.m_clientObject);
  }
  return proxy.is_ghost;
}

void Broadphase::Impl::begin_eagerly(Proxy& proxy, btDispatcher* dispatcher) {
  if (!computes_pairs || world_is_busy || !wants_eager(proxy, dispatcher)) return;
  BT_PROFILE("boxstream::beginPairs");
  std::vector<KeyedPair> found;
  or_fatal([&] {
    learn_from_cache(dispatcher);
    const bool default_rule = default_rule_holds();
    neighbours.clear();
    world.query_box(world_box(proxy), [&](ProxyId id) {
      neighbours.push_back(&proxy_of(id));
      return true;
    });
    for (Proxy* neighbour : neighbours) sync_filter(*neighbour, default_rule);
    {
      const bool asks = own && !default_rule;
      const Busy busy(*this);
      world.begin_pairs_of(
          proxy.id, [&](ProxyId a, ProxyId b) { return !asks || accepts(a, b); },
          [&](ProxyPair pair) { found.emplace_back(proxy_of(pair.a), proxy_of(pair.b)); });
    }
    std::erase_if(found, [](const KeyedPair& pair) {
      return static_cast<const Proxy*>(pair.pair.m_pProxy0)->dying ||
             static_cast<const Proxy*>(pair.pair.m_pProxy1)->dying;
    });
    catch_up();
    std::sort(found.begin(), found.end());
  });
  if (own) {
    for (const KeyedPair& pair : found) own->begin_early(pair);
  } else {
    add_to_borrowed(found);
    borrowed_pairs = cache->getNumOverlappingPairs();
  }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
