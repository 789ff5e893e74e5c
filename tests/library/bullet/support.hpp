// SPDX-License-Identifier: MIT
#pragma once

#include <btBulletCollisionCommon.h>
#include <gtest/gtest.h>

#include <deque>
#include <functional>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "subject.hpp"

namespace boxstream::bullet_test {

struct Box {
  btVector3 lo;
  btVector3 hi;
};

/// A cube by centre and half edge.
inline Box cube(btScalar x, btScalar y, btScalar z, btScalar half = btScalar(0.5)) {
  return {btVector3(x - half, y - half, z - half), btVector3(x + half, y + half, z + half)};
}

using UidPair = std::pair<int, int>;

/// Pairs of unique ids in the order of the pair array, by its pointer. Fails the test if the array is not dense.
std::vector<UidPair> pairs_of(btBroadphaseInterface& broadphase);
/// The same, sorted.
std::vector<UidPair> sorted_pairs_of(btBroadphaseInterface& broadphase);
/// The pair of two proxies in the array, whichever order; null if not held.
btBroadphasePair* find_in_array(btBroadphaseInterface& broadphase, const btBroadphaseProxy* a,
                                const btBroadphaseProxy* b);

/// A real dispatcher that counts the algorithms it lends out.
class CountingDispatcher : public btCollisionDispatcher {
 public:
  using btCollisionDispatcher::btCollisionDispatcher;
  void* allocateCollisionAlgorithm(int size) override {
    ++allocated;
    return btCollisionDispatcher::allocateCollisionAlgorithm(size);
  }
  void freeCollisionAlgorithm(void* memory) override {
    ++freed;
    btCollisionDispatcher::freeCollisionAlgorithm(memory);
  }
  long allocated = 0;
  long freed = 0;
};

/// An algorithm that only tells when it is destroyed.
class PlantedAlgorithm : public btCollisionAlgorithm {
 public:
  explicit PlantedAlgorithm(int* destroyed) : destroyed_(destroyed) {}
  ~PlantedAlgorithm() override { ++*destroyed_; }
  void processCollision(const btCollisionObjectWrapper*, const btCollisionObjectWrapper*, const btDispatcherInfo&,
                        btManifoldResult*) override {}
  btScalar calculateTimeOfImpact(btCollisionObject*, btCollisionObject*, const btDispatcherInfo&,
                                 btManifoldResult*) override {
    return 1;
  }
  void getAllContactManifolds(btManifoldArray&) override {}

 private:
  int* destroyed_;
};

/// A ghost callback that writes down its events and looks at both clients, as btGhostPairCallback does.
class GhostLog : public btOverlappingPairCallback {
 public:
  struct Event {
    bool add;
    int uid0;
    int uid1;
    const void* client0;
    const void* client1;
  };
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b) override {
    record(true, a, b);
    return nullptr;
  }
  void* removeOverlappingPair(btBroadphaseProxy* a, btBroadphaseProxy* b, btDispatcher*) override {
    record(false, a, b);
    return nullptr;
  }
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy*, btDispatcher*) override {
    ADD_FAILURE() << "ghost callbacks do not implement removal by proxy";
  }
  int adds() const;
  int removes() const;
  /// Pairs added and not removed since, sorted; fails the test on an add of a held pair or a remove of an absent one.
  std::vector<UidPair> standing() const;

  std::vector<Event> events;
  std::function<void(const Event&)> on_event;

 private:
  void record(bool add, const btBroadphaseProxy* a, const btBroadphaseProxy* b);
};

/// A filter made from a function; counts its calls.
class FunctionFilter : public btOverlapFilterCallback {
 public:
  explicit FunctionFilter(std::function<bool(btBroadphaseProxy*, btBroadphaseProxy*)> accept)
      : accept_(std::move(accept)) {}
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    ++calls;
    return accept_(a, b);
  }
  mutable long calls = 0;

 private:
  std::function<bool(btBroadphaseProxy*, btBroadphaseProxy*)> accept_;
};

/// A broad-phase with a real dispatcher and clients, without a world. Clients are collision objects without a shape.
class Rig {
 public:
  explicit Rig(Kind kind = Kind::subject, btOverlappingPairCache* cache = nullptr)
      : dispatcher(&config), broadphase(make_broadphase(kind, cache)), frees_leftovers_(kind == Kind::subject) {}
  ~Rig();

  btBroadphaseProxy* create(const Box& box, int group = 1, int mask = -1);
  btBroadphaseProxy* create_for(btCollisionObject* client, const Box& box, int group = 1, int mask = -1);
  void move(btBroadphaseProxy* proxy, const Box& box) { broadphase->setAabb(proxy, box.lo, box.hi, &dispatcher); }
  void destroy(btBroadphaseProxy* proxy) { destroy(proxy, &dispatcher); }
  void destroy(btBroadphaseProxy* proxy, btDispatcher* with);
  void calculate() { broadphase->calculateOverlappingPairs(&dispatcher); }
  btOverlappingPairCache& cache() { return *broadphase->getOverlappingPairCache(); }
  std::vector<UidPair> pairs() { return pairs_of(*broadphase); }
  int pair_count() { return cache().getNumOverlappingPairs(); }
  bool holds(const btBroadphaseProxy* a, const btBroadphaseProxy* b) {
    return find_in_array(*broadphase, a, b) != nullptr;
  }
  /// Gives the pair an algorithm of this rig's dispatcher, as the near callback would.
  btCollisionAlgorithm* plant(const btBroadphaseProxy* a, const btBroadphaseProxy* b);

  std::vector<const btBroadphaseProxy*> in_box(const Box& box);
  std::vector<const btBroadphaseProxy*> on_ray(const btVector3& from, const btVector3& to,
                                               const btVector3& extent_min = btVector3(0, 0, 0),
                                               const btVector3& extent_max = btVector3(0, 0, 0));

  btDefaultCollisionConfiguration config;
  CountingDispatcher dispatcher;
  std::unique_ptr<btBroadphaseInterface> broadphase;
  std::deque<btCollisionObject> clients;
  int algorithms_destroyed = 0;

 private:
  bool frees_leftovers_;  ///< Bullet's own leak proxies that live when they are deleted
  std::vector<btBroadphaseProxy*> live_;
};

/// n cubes in a row, each touching the next two.
std::vector<btBroadphaseProxy*> make_row(Rig& rig, int n);

/// n unit cubes with centres at random within +-extent.
std::vector<btBroadphaseProxy*> make_heap(Rig& rig, int n, std::uint64_t start, btScalar extent);

/// Collects what a query reports, in order; what it returns to the broad-phase can be chosen.
/// Natives may hand out proxies of their own, so clients are what is compared.
struct Found : btBroadphaseAabbCallback {
  bool process(const btBroadphaseProxy* proxy) override {
    proxies.push_back(proxy);
    if (also) also(proxy);
    return answer;
  }
  std::vector<const void*> clients() const;

  std::vector<const btBroadphaseProxy*> proxies;
  std::function<void(const btBroadphaseProxy*)> also;
  bool answer = true;
};

struct FoundOnRay : btBroadphaseRayCallback {
  /// Fills in the ray as btCollisionWorld::rayTest does; `huge` stands for the inverse of zero.
  FoundOnRay(const btVector3& from, const btVector3& to, btScalar huge = BT_LARGE_FLOAT);
  bool process(const btBroadphaseProxy* proxy) override {
    proxies.push_back(proxy);
    if (also) also(proxy);
    return answer;
  }
  std::vector<const void*> clients() const;

  std::vector<const btBroadphaseProxy*> proxies;
  std::function<void(const btBroadphaseProxy*)> also;
  bool answer = true;
};

/// Small reproducible random numbers; the same on every platform.
class Random {
 public:
  explicit Random(std::uint64_t start) : state_(start * 0x9E3779B97F4A7C15u + 1) {}
  std::uint32_t bits() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return static_cast<std::uint32_t>(state_ >> 32);
  }
  int below(int n) { return static_cast<int>(bits() % static_cast<std::uint32_t>(n)); }
  btScalar real(btScalar lo, btScalar hi) { return lo + (hi - lo) * btScalar(bits()) / btScalar(4294967296.0); }
  btVector3 vector(btScalar lo, btScalar hi) {
    const btScalar x = real(lo, hi), y = real(lo, hi), z = real(lo, hi);
    return btVector3(x, y, z);
  }

 private:
  std::uint64_t state_;
};

template <class T>
std::vector<T> sorted(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace boxstream::bullet_test
