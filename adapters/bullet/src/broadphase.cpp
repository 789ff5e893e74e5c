// SPDX-License-Identifier: MIT
#include <boxstream/bullet.hpp>

#include <cassert>
#include <cstdint>
#include <limits>

#include "abi_check.hpp"
#include "borrowed_cache.hpp"
#include "broadphase_impl.hpp"
#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

Options checked(Options options) {
  if (!(options.margin >= 0)) options.margin = 0;
  return options;
}

WorldOptions world_options(const Options& options) {
  WorldOptions world;
  world.executor = options.executor;
  world.sticky_filters = true;
  return world;
}

bool same(const btVector3& a, const btVector3& b) {
  return a.x() == b.x() && a.y() == b.y() && a.z() == b.z();
}

}  // namespace

Broadphase::Impl::Impl(btOverlappingPairCache* borrowed, const Options& given)
    : options(checked(given)),
      own(borrowed ? nullptr : new PairCache),
      cache(borrowed ? borrowed : own.get()),
      computes_pairs(!borrowed || keeps_pairs(*borrowed)),
      world(world_options(options)),
      borrowed_pairs(borrowed ? borrowed->getNumOverlappingPairs() : 0) {}

Broadphase::Impl::~Impl() {
  for (Proxy* proxy : live) delete proxy;
}

Proxy* Broadphase::Impl::create(const btVector3& lo, const btVector3& hi, void* client, int group, int mask) {
  if (last_uid == std::numeric_limits<std::int32_t>::max()) fatal("2^31 proxies created; no unique ids are left");
  return or_fatal([&] {
    auto* proxy = new Proxy(lo, hi, client, group, mask);
    proxy->m_uniqueId = ++last_uid;
    proxy->position = std::uint32_t(live.size());
    live.push_back(proxy);
    if (!postpone(*proxy)) tell_world(*proxy);
    return proxy;
  });
}

void Broadphase::Impl::destroy(Proxy& proxy, btDispatcher* dispatcher) {
  assert((!own || !own->is_calling_out()) && "callbacks for pairs must not destroy proxies");
  if (own) {
    own->remove_all_of(proxy, dispatcher);
  } else {
    borrowed_pairs -= cache->getNumOverlappingPairs();
    cache->removeOverlappingPairsContainingProxy(&proxy, dispatcher);
    borrowed_pairs += cache->getNumOverlappingPairs();
  }
  live.back()->position = proxy.position;
  live[proxy.position] = live.back();
  live.pop_back();
  proxy.dying = true;
  if (!postpone(proxy)) forget(proxy);
}

void Broadphase::Impl::move(Proxy& proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) {
  const bool unchanged = same(proxy.m_aabbMin, lo) && same(proxy.m_aabbMax, hi);
  proxy.m_aabbMin = lo;
  proxy.m_aabbMax = hi;
  if (unchanged || postpone(proxy)) return;
  tell_world(proxy);
  begin_eagerly(proxy, dispatcher);
}

void Broadphase::Impl::reset() {
  if (!live.empty() || world_is_busy) return;
  or_fatal([&] { world.clear(); });
  if (own) own->removed_by_users().clear();
  last_uid = 0;
}

Broadphase::Impl::Box Broadphase::Impl::world_box(const Proxy& proxy) const {
  const Box box = box_of(proxy.m_aabbMin, proxy.m_aabbMax);
  return options.margin > 0 && is_valid(box) ? expanded(box, options.margin) : box;
}

void Broadphase::Impl::tell_world(Proxy& proxy) {
  or_fatal([&] {
    if (proxy.id)
      world.move(proxy.id, world_box(proxy));
    else {
      sync_filter(proxy, default_rule_holds());
      proxy.id = world.create(world_box(proxy), proxy.told, reinterpret_cast<std::uintptr_t>(&proxy));
    }
  });
}

bool Broadphase::Impl::postpone(Proxy& proxy) {
  assert(!world_is_busy && "callbacks for pairs must not create, change or destroy proxies");
  if (!world_is_busy) return false;
  if (!proxy.late) or_fatal([&] { late.push_back(&proxy); });
  proxy.late = true;
  return true;
}

void Broadphase::Impl::catch_up() {
  for (Proxy* proxy : late) {
    proxy->late = false;
    if (proxy->dying)
      forget(*proxy);
    else
      tell_world(*proxy);
  }
  late.clear();
}

void Broadphase::Impl::forget(Proxy& proxy) {
  if (proxy.id) world.destroy(proxy.id);
  delete &proxy;
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
  impl_->begin_eagerly(*proxy, dispatcher);
  return proxy;
}

void Broadphase::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  impl_->destroy(static_cast<Proxy&>(*proxy), dispatcher);
}

void Broadphase::setAabb(btBroadphaseProxy* proxy, const btVector3& aabbMin, const btVector3& aabbMax,
                         btDispatcher* dispatcher) {
  impl_->move(static_cast<Proxy&>(*proxy), aabbMin, aabbMax, dispatcher);
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
  const auto bounds = impl_->world.bounds();
  const bool any = is_valid(bounds);
  aabbMin.setValue(any ? bounds.min[0] : 0, any ? bounds.min[1] : 0, any ? bounds.min[2] : 0);
  aabbMax.setValue(any ? bounds.max[0] : 0, any ? bounds.max[1] : 0, any ? bounds.max[2] : 0);
}

void Broadphase::resetPool(btDispatcher*) {
  impl_->reset();
}

void Broadphase::printStats() {}

const WorldStats& Broadphase::stats() const {
  return impl_->stats;
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
