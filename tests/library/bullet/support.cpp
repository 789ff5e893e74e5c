// SPDX-License-Identifier: MIT
#include "support.hpp"

#include <algorithm>
#include <new>
#include <set>

namespace boxstream::bullet_test {

std::vector<UidPair> pairs_of(btBroadphaseInterface& broadphase) {
  btOverlappingPairCache& cache = *broadphase.getOverlappingPairCache();
  const int count = cache.getNumOverlappingPairs();
  std::vector<UidPair> pairs;
  if (count == 0) return pairs;
  btBroadphasePair* first = cache.getOverlappingPairArrayPtr();
  for (int i = 0; i < count; ++i) {
    if (!first[i].m_pProxy0 || !first[i].m_pProxy1) {
      ADD_FAILURE() << "hole at " << i << " of " << count;
      continue;
    }
    pairs.emplace_back(first[i].m_pProxy0->m_uniqueId, first[i].m_pProxy1->m_uniqueId);
  }
  return pairs;
}

std::vector<UidPair> sorted_pairs_of(btBroadphaseInterface& broadphase) {
  return sorted(pairs_of(broadphase));
}

btBroadphasePair* find_in_array(btBroadphaseInterface& broadphase, const btBroadphaseProxy* a,
                                const btBroadphaseProxy* b) {
  btOverlappingPairCache& cache = *broadphase.getOverlappingPairCache();
  const int count = cache.getNumOverlappingPairs();
  if (count == 0) return nullptr;
  btBroadphasePair* first = cache.getOverlappingPairArrayPtr();
  for (btBroadphasePair* pair = first; pair != first + count; ++pair)
    if ((pair->m_pProxy0 == a && pair->m_pProxy1 == b) || (pair->m_pProxy0 == b && pair->m_pProxy1 == a)) return pair;
  return nullptr;
}

int GhostLog::adds() const {
  return static_cast<int>(std::count_if(events.begin(), events.end(), [](const Event& e) { return e.add; }));
}

int GhostLog::removes() const {
  return static_cast<int>(events.size()) - adds();
}

std::vector<UidPair> GhostLog::standing() const {
  std::set<UidPair> held;
  for (const Event& event : events) {
    const UidPair pair = std::minmax(event.uid0, event.uid1);
    if (event.add) {
      EXPECT_TRUE(held.insert(pair).second) << "added twice: " << pair.first << ", " << pair.second;
    } else {
      EXPECT_EQ(held.erase(pair), 1u) << "removed without being held: " << pair.first << ", " << pair.second;
    }
  }
  return {held.begin(), held.end()};
}

void GhostLog::record(bool add, const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
  events.push_back({add, a->m_uniqueId, b->m_uniqueId, a->m_clientObject, b->m_clientObject});
  if (on_event) on_event(events.back());
}

btBroadphaseProxy* Rig::create(const Box& box, int group, int mask) {
  clients.emplace_back();
  return create_for(&clients.back(), box, group, mask);
}

btBroadphaseProxy* Rig::create_for(btCollisionObject* client, const Box& box, int group, int mask) {
  live_.push_back(broadphase->createProxy(box.lo, box.hi, BOX_SHAPE_PROXYTYPE, client, group, mask, &dispatcher));
  return live_.back();
}

void Rig::destroy(btBroadphaseProxy* proxy, btDispatcher* with) {
  live_.erase(std::remove(live_.begin(), live_.end(), proxy), live_.end());
  broadphase->destroyProxy(proxy, with);
}

Rig::~Rig() {
  if (frees_leftovers_) return;
  cache().setInternalGhostPairCallback(nullptr);
  for (btBroadphaseProxy* proxy : live_) broadphase->destroyProxy(proxy, &dispatcher);
}

btCollisionAlgorithm* Rig::plant(const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
  btBroadphasePair* pair = find_in_array(*broadphase, a, b);
  if (!pair) {
    ADD_FAILURE() << "no pair to plant an algorithm in";
    return nullptr;
  }
  void* memory = dispatcher.allocateCollisionAlgorithm(sizeof(PlantedAlgorithm));
  pair->m_algorithm = new (memory) PlantedAlgorithm(&algorithms_destroyed);
  return pair->m_algorithm;
}

std::vector<const btBroadphaseProxy*> Rig::in_box(const Box& box) {
  Found found;
  broadphase->aabbTest(box.lo, box.hi, found);
  return sorted(found.proxies);
}

std::vector<const btBroadphaseProxy*> Rig::on_ray(const btVector3& from, const btVector3& to,
                                                  const btVector3& extent_min, const btVector3& extent_max) {
  FoundOnRay found(from, to);
  broadphase->rayTest(from, to, found, extent_min, extent_max);
  return sorted(found.proxies);
}

std::vector<btBroadphaseProxy*> make_row(Rig& rig, int n) {
  std::vector<btBroadphaseProxy*> row;
  for (int i = 0; i < n; ++i) row.push_back(rig.create(cube(btScalar(i) / 2, 0, 0)));
  return row;
}

std::vector<btBroadphaseProxy*> make_heap(Rig& rig, int n, std::uint64_t start, btScalar extent) {
  Random random(start);
  std::vector<btBroadphaseProxy*> heap;
  for (int i = 0; i < n; ++i) {
    const btVector3 p = random.vector(-extent, extent);
    heap.push_back(rig.create(cube(p.x(), p.y(), p.z())));
  }
  return heap;
}

namespace {
std::vector<const void*> sorted_clients(const std::vector<const btBroadphaseProxy*>& proxies) {
  std::vector<const void*> clients;
  for (const btBroadphaseProxy* proxy : proxies) clients.push_back(proxy->m_clientObject);
  return sorted(clients);
}
}  // namespace

std::vector<const void*> Found::clients() const {
  return sorted_clients(proxies);
}
std::vector<const void*> FoundOnRay::clients() const {
  return sorted_clients(proxies);
}

FoundOnRay::FoundOnRay(const btVector3& from, const btVector3& to, btScalar huge) {
  const btVector3 direction = (to - from) / (to - from).length();
  for (int d = 0; d < 3; ++d) {
    m_rayDirectionInverse[d] = direction[d] == 0 ? huge : 1 / direction[d];
    m_signs[d] = m_rayDirectionInverse[d] < 0;
  }
  m_lambda_max = direction.dot(to - from);
}

}  // namespace boxstream::bullet_test
