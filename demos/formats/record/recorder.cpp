// SPDX-License-Identifier: MIT
#include "formats/record/recorder.hpp"

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <algorithm>
#include <cassert>

namespace boxstream::record {
namespace {

void copy(const btVector3& from, double (&to)[3]) {
  for (int d = 0; d < 3; ++d) to[d] = from[d];
}

Aabb64 box_of(const btVector3& lo, const btVector3& hi) {
  Aabb64 box{};
  copy(lo, box.min);
  copy(hi, box.max);
  return box;
}

}  // namespace

Recorder::Recorder(std::unique_ptr<btBroadphaseInterface> inner, Writer& writer)
    : ForwardingBroadphase(std::move(inner)), writer_(writer) {
  assert(writer.scalar() == bullet_scalar);
}

btBroadphaseProxy* Recorder::createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client,
                                         int group, int mask, btDispatcher* dispatcher) {
  btBroadphaseProxy* const proxy = inner().createProxy(lo, hi, shape_type, client, group, mask, dispatcher);
  if (proxy == nullptr) return nullptr;  // btSimpleBroadphase when it is full
  const Aabb64 box = box_of(lo, hi);
  places_[proxy] = live_.size();
  live_.push_back({proxy, created_, group, mask, box});
  write(Create{created_++, shape_type, group, mask, box});
  return proxy;
}

void Recorder::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  const auto found = places_.find(proxy);
  const std::size_t place = found->second;
  write(Destroy{live_[place].id});
  places_.erase(found);
  if (place + 1 != live_.size()) {
    live_[place] = live_.back();
    places_[live_[place].proxy] = place;
  }
  live_.pop_back();
  inner().destroyProxy(proxy, dispatcher);
}

void Recorder::setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) {
  Known& moved = known(proxy);
  note_filter(moved);
  moved.box = box_of(lo, hi);
  write(Move{moved.id, moved.box});
  inner().setAabb(proxy, lo, hi, dispatcher);
}

void Recorder::rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback,
                       const btVector3& lo, const btVector3& hi) {
  RayQuery op{};
  copy(from, op.from);
  copy(to, op.to);
  copy(callback.m_rayDirectionInverse, op.inverse_direction);
  op.length = callback.m_lambda_max;
  copy(lo, op.extent_min);
  copy(hi, op.extent_max);
  write(op);
  inner().rayTest(from, to, callback, lo, hi);
}

void Recorder::aabbTest(const btVector3& lo, const btVector3& hi, btBroadphaseAabbCallback& callback) {
  write(BoxQuery{box_of(lo, hi)});
  inner().aabbTest(lo, hi, callback);
}

void Recorder::calculateOverlappingPairs(btDispatcher* dispatcher) {
  for (Known& each : live_) note_filter(each);
  inner().calculateOverlappingPairs(dispatcher);
  write(Batch{overlapping_pairs()});
}

void Recorder::resetPool(btDispatcher* dispatcher) {
  write(ResetPool{});
  inner().resetPool(dispatcher);
}

void Recorder::note_filter(Known& known) {
  const int group = known.proxy->m_collisionFilterGroup, mask = known.proxy->m_collisionFilterMask;
  if (group == known.group && mask == known.mask) return;
  known.group = group;
  known.mask = mask;
  write(Refilter{known.id, group, mask});
}

PairDigest Recorder::overlapping_pairs() const {
  const btOverlappingPairCache& cache = *getOverlappingPairCache();
  const int count = cache.getNumOverlappingPairs();
  const btBroadphasePair* const pairs = count > 0 ? cache.getOverlappingPairArrayPtr() : nullptr;
  PairDigest digest;
  for (int i = 0; i < count; ++i) {
    const Known& a = live_[places_.at(pairs[i].m_pProxy0)];
    const Known& b = live_[places_.at(pairs[i].m_pProxy1)];
    if (is_valid(a.box) && is_valid(b.box) && overlaps(a.box, b.box))
      digest.add({std::min(a.id, b.id), std::max(a.id, b.id)});
  }
  return digest;
}

void Recorder::write(const Op& op) {
  const std::lock_guard lock(writing_);
  writer_.write(op);
}

}  // namespace boxstream::record
