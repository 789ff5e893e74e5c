// SPDX-License-Identifier: MIT
// Replaces btDbvtBroadphase. The object stays Bullet's, made and ended by Bullet's own functions, so that its layout,
// its vtable and classes derived from it hold; its trees stay empty.
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <boxstream/bullet.hpp>

#include "backend.hpp"
#include "bullet_check.hpp"
#include "registry.hpp"

namespace boxstream::preload {
namespace {

using Ours = bullet::Broadphase;

Front front;

bullet::Options options() {
  bullet::Options options;
  if (const char* eager = std::getenv("BOXSTREAM_TRY_EAGER")) {
    options.eager = std::strcmp(eager, "all") == 0    ? bullet::Eager::all
                    : std::strcmp(eager, "none") == 0 ? bullet::Eager::none
                                                      : bullet::Eager::ghosts;
  }
  if (const char* margin = std::getenv("BOXSTREAM_TRY_MARGIN")) {
    options.margin = static_cast<btScalar>(std::strtod(margin, nullptr));
  }
  return options;
}

/// For tests of --check: it must notice boxes that are larger than it knows.
bullet::Options with_untold_margin(bullet::Options options) {
  if (const char* margin = std::getenv("BOXSTREAM_TRY_UNTOLD_MARGIN")) {
    options.margin += static_cast<btScalar>(std::strtod(margin, nullptr));
  }
  return options;
}

bool wants_order_of_engine() {
  const char* const order = std::getenv("BOXSTREAM_TRY_ORDER");
  return order && std::strcmp(order, "engine") == 0;
}

/// What stands for one btDbvtBroadphase.
class Stand {
 public:
  Stand(btDbvtBroadphase& self, btOverlappingPairCache* given, const bullet::Options& options)
      : self_(self),
        cache_of_self_(self.m_paircache),
        // Bullet's own cache keeps pairs in another order than ours.
        hashed_(!given && wants_order_of_engine() ? new btHashedOverlappingPairCache : nullptr),
        ours_(given ? given : hashed_.get(), with_untold_margin(options)) {
    if (front.mode == Mode::check) {
      own_cache_.emplace();
      check_ = std::make_unique<BulletCheck>(front, self_, ours_, *own_cache_, options.margin);
    }
    self_.m_paircache = ours_.getOverlappingPairCache();
  }
  ~Stand() { self_.m_paircache = cache_of_self_; }
  Stand(const Stand&) = delete;
  Stand& operator=(const Stand&) = delete;

  Ours& ours() { return ours_; }
  BulletCheck* check() { return check_.get(); }

 private:
  btDbvtBroadphase& self_;
  btOverlappingPairCache* cache_of_self_;
  std::unique_ptr<btHashedOverlappingPairCache> hashed_;
  Ours ours_;
  std::optional<btHashedOverlappingPairCache> own_cache_;
  std::unique_ptr<BulletCheck> check_;
};

Registry<Stand> stands;

template <class T>
T& ref(Word word) {
  return *reinterpret_cast<T*>(word);
}
template <class T>
T* pointer(Word word) {
  return reinterpret_cast<T*>(word);
}
template <class T>
Word word(T* pointer) {
  return reinterpret_cast<Word>(pointer);
}

void note_pairs(btOverlappingPairCache* cache) {
  const auto pairs = static_cast<std::uint64_t>(cache->getNumOverlappingPairs());
  front.tally->pairs.store(pairs, std::memory_order_relaxed);
  if (pairs > front.tally->most_pairs.load(std::memory_order_relaxed)) {
    front.tally->most_pairs.store(pairs, std::memory_order_relaxed);
  }
}

bool is_batch(BulletMember member) {
  return member == BulletMember::calculate_overlapping_pairs || member == BulletMember::collide;
}

Word measure(unsigned site, BulletMember member, const Words& w) {
  const Word result = front.own(site, w);
  if (is_batch(member)) note_pairs(ref<btDbvtBroadphase>(w.at[0]).m_paircache);
  return result;
}

Word replace(unsigned site, BulletMember member, const Words& w) {
  const auto& a = w.at;
  auto* const self = pointer<btDbvtBroadphase>(a[0]);
  if (member == BulletMember::construct || member == BulletMember::construct_base) {
    front.own(site, w);
    stands.add(self, std::make_unique<Stand>(*self, pointer<btOverlappingPairCache>(a[1]), options()));
    return 0;
  }
  if (member == BulletMember::destroy || member == BulletMember::destroy_base ||
      member == BulletMember::destroy_and_free) {
    stands.remove(self);
    return front.own(site, w);
  }
  Stand* const stand = stands.find(self);
  if (!stand) return front.own(site, w);  // was there before this library
  Ours& ours = stand->ours();
  BulletCheck* const check = stand->check();
  const auto vector = [&a](int i) -> const btVector3& { return ref<const btVector3>(a[i]); };
  const auto dispatcher = [&a](int i) { return pointer<btDispatcher>(a[i]); };
  auto* const proxy = pointer<btBroadphaseProxy>(a[1]);
  switch (member) {
    case BulletMember::create_proxy: {
      auto* const made = ours.createProxy(vector(1), vector(2), static_cast<int>(a[3]), pointer<void>(a[4]),
                                          static_cast<int>(a[5]), static_cast<int>(a[6]), dispatcher(7));
      if (check) check->created(made, static_cast<int>(a[3]));
      return word(made);
    }
    case BulletMember::destroy_proxy:
      if (check) check->destroyed(proxy);
      ours.destroyProxy(proxy, dispatcher(2));
      return 0;
    case BulletMember::set_aabb:
    case BulletMember::set_aabb_force_update:
      ours.setAabb(proxy, vector(2), vector(3), dispatcher(4));
      if (check) check->moved(proxy);
      return 0;
    case BulletMember::ray_test: {
      auto& callback = ref<btBroadphaseRayCallback>(a[3]);
      if (check) check->ray(vector(1), vector(2), callback, vector(4), vector(5));
      ours.rayTest(vector(1), vector(2), callback, vector(4), vector(5));
      return 0;
    }
    case BulletMember::aabb_test:
      if (check) check->box(vector(1), vector(2));
      ours.aabbTest(vector(1), vector(2), ref<btBroadphaseAabbCallback>(a[3]));
      return 0;
    case BulletMember::calculate_overlapping_pairs:
    case BulletMember::collide:
      ours.calculateOverlappingPairs(dispatcher(1));
      if (check) check->batch();
      note_pairs(ours.getOverlappingPairCache());
      return 0;
    case BulletMember::get_aabb:
      ours.getAabb(proxy, ref<btVector3>(a[2]), ref<btVector3>(a[3]));
      return 0;
    case BulletMember::get_broadphase_aabb:
      ours.getBroadphaseAabb(ref<btVector3>(a[1]), ref<btVector3>(a[2]));
      return 0;
    case BulletMember::get_cache:
    case BulletMember::get_cache_const:
      return word(ours.getOverlappingPairCache());
    case BulletMember::reset_pool:
      ours.resetPool(dispatcher(1));
      return 0;
    default:  // nothing to do: optimize, performDeferredRemoval, printStats
      return 0;
  }
}

Word serve(unsigned site, unsigned, unsigned member, const Words& words) {
  const auto which = static_cast<BulletMember>(member);
  return front.mode == Mode::measure ? measure(site, which, words) : replace(site, which, words);
}

}  // namespace
}  // namespace boxstream::preload

extern "C" __attribute__((visibility("default"))) boxstream::preload::Backend boxstream_preload_backend(
    const boxstream::preload::Front& front) {
  boxstream::preload::front = front;
  return {boxstream::preload::serve};
}
