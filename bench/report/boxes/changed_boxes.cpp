// SPDX-License-Identifier: MIT
#include "boxes/changed_boxes.hpp"

#include <algorithm>
#include <utility>

#include <btBulletCollisionCommon.h>

namespace boxstream::report {
namespace {

Aabb box_of(const btVector3& lo, const btVector3& hi) {
  Aabb box{};
  for (int d = 0; d < 3; ++d) {
    box.min[d] = static_cast<float>(lo[d]);
    box.max[d] = static_cast<float>(hi[d]);
  }
  return box;
}

btVector3 low(const Aabb& box) {
  return {box.min[0], box.min[1], box.min[2]};
}

btVector3 high(const Aabb& box) {
  return {box.max[0], box.max[1], box.max[2]};
}

bool accepts(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  return (a.m_collisionFilterGroup & b.m_collisionFilterMask) != 0 &&
         (b.m_collisionFilterGroup & a.m_collisionFilterMask) != 0;
}

}  // namespace

Aabb tight_box(const Aabb& given) {
  return expanded(given, -static_cast<float>(gContactBreakingThreshold));
}

Aabb sphere_box(const Aabb& given, const btCollisionObject& object) {
  btVector3 centre;
  btScalar radius = 0;
  object.getCollisionShape()->getBoundingSphere(centre, radius);
  centre = object.getWorldTransform() * centre;
  const btScalar reach = radius + gContactBreakingThreshold;
  const btVector3 half(reach, reach, reach);
  return merged(given, box_of(centre - half, centre + half));
}

ChangedBoxes::ChangedBoxes(std::unique_ptr<btBroadphaseInterface> inner, ChangeOfBox change)
    : ForwardingBroadphase(std::move(inner)), change_(std::move(change)) {}

btBroadphaseProxy* ChangedBoxes::createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client,
                                             int group, int mask, btDispatcher* dispatcher) {
  const Aabb given = box_of(lo, hi);
  const Aabb box = change_(given, *static_cast<const btCollisionObject*>(client));
  btBroadphaseProxy* const proxy =
      ForwardingBroadphase::createProxy(low(box), high(box), shape_type, client, group, mask, dispatcher);
  given_[proxy] = given;
  return proxy;
}

void ChangedBoxes::destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) {
  given_.erase(proxy);
  ForwardingBroadphase::destroyProxy(proxy, dispatcher);
}

void ChangedBoxes::setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi,
                           btDispatcher* dispatcher) {
  const Aabb given = box_of(lo, hi);
  given_[proxy] = given;
  const Aabb box = change_(given, *static_cast<const btCollisionObject*>(proxy->m_clientObject));
  ForwardingBroadphase::setAabb(proxy, low(box), high(box), dispatcher);
}

std::vector<Pair> ChangedBoxes::needed_pairs() const {
  struct Entry {
    const btBroadphaseProxy* proxy;
    std::uint32_t index;
    Aabb box;
  };
  std::vector<Entry> entries;
  for (const auto& [proxy, given] : given_) {
    const auto* const object = static_cast<const btCollisionObject*>(proxy->m_clientObject);
    entries.push_back({proxy, static_cast<std::uint32_t>(object->getUserIndex()), tight_box(given)});
  }
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < entries.size(); ++i)
    for (std::size_t j = i + 1; j < entries.size(); ++j)
      if (overlaps(entries[i].box, entries[j].box) && accepts(*entries[i].proxy, *entries[j].proxy))
        pairs.push_back({std::min(entries[i].index, entries[j].index), std::max(entries[i].index, entries[j].index)});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace boxstream::report
