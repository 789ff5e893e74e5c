// SPDX-License-Identifier: MIT
// Each allocation fails, and each two. Bullet's interface has no way to say so: one line on stderr, and abort; never a
// wrong answer, or a crash somewhere else. Each case is a process of its own.
#include <gtest/gtest.h>
#include <malloc.h>
#include <sys/wait.h>
#include <boxstream/bullet.hpp>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "heap_watch.hpp"
#include "oracle.hpp"
#include "sanitized.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

namespace heap_watch = boxstream::tests::heap_watch;
using boxstream::bullet::Broadphase;
using boxstream::bullet::Eager;
using heap_watch::Failures;

/// Allocations fail in calls of the broad-phase, not in the code that observes it.
class Flaky final : public boxstream::record::ForwardingBroadphase {
 public:
  using Base = boxstream::record::ForwardingBroadphase;
  using Base::Base;

  btBroadphaseProxy* createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client, int group,
                                 int mask, btDispatcher* dispatcher) override {
    const Failures come(true);
    return Base::createProxy(lo, hi, shape_type, client, group, mask, dispatcher);
  }
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override {
    const Failures come(true);
    Base::destroyProxy(proxy, dispatcher);
  }
  void setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) override {
    const Failures come(true);
    Base::setAabb(proxy, lo, hi, dispatcher);
  }
  void rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback, const btVector3& lo,
               const btVector3& hi) override {
    const Failures come(true);
    Base::rayTest(from, to, callback, lo, hi);
  }
  void aabbTest(const btVector3& lo, const btVector3& hi, btBroadphaseAabbCallback& callback) override {
    const Failures come(true);
    Base::aabbTest(lo, hi, callback);
  }
  void calculateOverlappingPairs(btDispatcher* dispatcher) override {
    const Failures come(true);
    Base::calculateOverlappingPairs(dispatcher);
  }
  void getBroadphaseAabb(btVector3& lo, btVector3& hi) const override {
    const Failures come(true);
    Base::getBroadphaseAabb(lo, hi);
  }
  void resetPool(btDispatcher* dispatcher) override {
    const Failures come(true);
    Base::resetPool(dispatcher);
  }
};

/// Writes down what it is told of, without failing.
struct Seen final : btBroadphaseRayCallback {
  bool process(const btBroadphaseProxy* proxy) override {
    const Failures wait(false);
    proxies.push_back(proxy);
    return true;
  }
  std::vector<const btBroadphaseProxy*> proxies;
};

struct Listener final : btOverlappingPairCallback {
  btBroadphasePair* addOverlappingPair(btBroadphaseProxy*, btBroadphaseProxy*) override { return nullptr; }
  void* removeOverlappingPair(btBroadphaseProxy*, btBroadphaseProxy*, btDispatcher*) override { return nullptr; }
  void removeOverlappingPairsContainingProxy(btBroadphaseProxy*, btDispatcher*) override {}
};

struct EveryThird final : btOverlapCallback {
  bool processOverlap(btBroadphasePair&) override { return ++calls % 3 == 0; }
  int calls = 0;
};

enum class Cache { own, hashed, sorted };

struct Setting {
  const char* name;
  Cache cache;
  Eager eager;
  bool filtered;
};

void PrintTo(const Setting& setting, std::ostream* out) {
  *out << setting.name;
}

const Setting settings[] = {{"own cache", Cache::own, Eager::ghosts, false},
                            {"own cache with a filter", Cache::own, Eager::none, true},
                            {"own cache, all pairs at once", Cache::own, Eager::all, true},
                            {"borrowed cache", Cache::hashed, Eager::all, true},
                            {"borrowed cache that is sorted", Cache::sorted, Eager::ghosts, false}};

/// Calls of all kinds on a broad-phase and on its cache. After each batch pairs and queries are compared with brute
/// force.
class History {
 public:
  explicit History(const Setting& setting)
      : filter_([](btBroadphaseProxy* a, btBroadphaseProxy* b) { return (a->m_uniqueId + b->m_uniqueId) % 3 != 0; }),
        users_change_pairs_(setting.cache != Cache::sorted) {
    boxstream::bullet::Options options;
    options.eager = setting.eager;
    options.exact_boxes = true;
    btOverlappingPairCache* const caches[] = {nullptr, &hashed_, &sorted_};
    std::unique_ptr<Broadphase> broadphase;
    void* const memory = ::operator new(sizeof(Broadphase));  // which is not its own business
    {
      const Failures come(true);
      broadphase.reset(::new (memory) Broadphase(caches[int(setting.cache)], options));
    }
    ours_ = broadphase.get();
    oracle_ = new Oracle(std::make_unique<Flaky>(std::move(broadphase)));
    rig_.broadphase.reset(oracle_);
    if (setting.filtered) rig_.cache().setOverlapFilterCallback(&filter_);
    if (setting.eager == Eager::all) rig_.cache().setInternalGhostPairCallback(&listener_);
  }

  /// What was wrong first, or null.
  const char* run() {
    for (int i = 0; i < 150; ++i) proxies_.push_back(rig_.create(some_box()));
    calculate();
    for (int round = 0; round < 4 && wrong_ == nullptr; ++round) {
      for (int i = 0; i < 20; ++i) rig_.move(any(), some_box());
      for (int i = 0; i < 12; ++i) destroy(random_.below(int(proxies_.size())));
      for (int i = 0; i < 6; ++i) proxies_.push_back(rig_.create(some_box()));
      any()->m_collisionFilterGroup = 2;
      compare_queries();
      if (users_change_pairs_) change_pairs(round);
      calculate();
    }
    while (!proxies_.empty()) destroy(int(proxies_.size()) - 1);
    rig_.broadphase->resetPool(&rig_.dispatcher);
    for (int i = 0; i < 30; ++i) proxies_.push_back(rig_.create(some_box()));
    calculate();
    for (int round = 0; round < 3; ++round) {
      rig_.move(any(), some_box());
      destroy(random_.below(int(proxies_.size())));
      if (users_change_pairs_ && round == 1) change_pairs(round);
      calculate();
    }
    return wrong_;
  }

 private:
  void expect(bool holds, const char* what) {
    if (!holds && wrong_ == nullptr) wrong_ = what;
  }

  btBroadphaseProxy* any() { return proxies_[std::size_t(random_.below(int(proxies_.size())))]; }
  Box some_box() {
    const btVector3 p = random_.vector(0, 8);
    return cube(p.x(), p.y(), p.z());
  }
  void destroy(int i) {
    rig_.destroy(proxies_[std::size_t(i)]);
    proxies_.erase(proxies_.begin() + i);
  }

  /// As users may: through the cache, which they have from the broad-phase.
  void change_pairs(int round) {
    btOverlappingPairCache& cache = rig_.cache();
    EveryThird callback;
    const Failures come(true);
    for (int i = 0; i < 20; ++i) {
      // Drawn one by one, so that all compilers have the same history.
      btBroadphaseProxy* proxies[6];
      for (btBroadphaseProxy*& proxy : proxies) proxy = any();
      cache.removeOverlappingPair(proxies[0], proxies[1], &rig_.dispatcher);
      if (proxies[2] != proxies[3]) cache.addOverlappingPair(proxies[2], proxies[3]);
      cache.findPair(proxies[4], proxies[5]);
    }
    cache.cleanProxyFromPairs(any(), &rig_.dispatcher);
    cache.removeOverlappingPairsContainingProxy(any(), &rig_.dispatcher);
    btDispatcherInfo info;
    info.m_deterministicOverlappingPairs = round % 2 == 0;
    cache.processAllOverlappingPairs(&callback, &rig_.dispatcher, info);
    cache.sortOverlappingPairs(&rig_.dispatcher);
  }

  void calculate() {
    rig_.calculate();
    const testing::AssertionResult pairs = oracle_->check(Rule::exact);
    expect(pairs, "pairs");
    if (!pairs) std::fprintf(stderr, "%s\n", pairs.message());
    compare_queries();
    try {
      ours_->validate();
    } catch (const std::exception& broken) {
      expect(false, broken.what());
    }
  }

  void compare_queries() {
    for (const btBroadphaseProxy* proxy : proxies_) {
      Seen found;
      rig_.broadphase->aabbTest(proxy->m_aabbMin, proxy->m_aabbMax, found);
      expect(sorted(found.proxies) == sorted(oracle_->expected_in_box(proxy->m_aabbMin, proxy->m_aabbMax)), "aabbTest");
    }
    btVector3 lo, hi, least(9, 9, 9), most(-9, -9, -9);
    rig_.broadphase->getBroadphaseAabb(lo, hi);
    for (const btBroadphaseProxy* proxy : proxies_) {
      least.setMin(proxy->m_aabbMin);
      most.setMax(proxy->m_aabbMax);
    }
    expect(lo == least && hi == most, "getBroadphaseAabb");
    compare_ray();
    compare_plane();
  }

  /// Along an axis, where exact arithmetic is no matter.
  void compare_ray() {
    const btVector3 middle = (any()->m_aabbMin + any()->m_aabbMax) / 2;
    const btVector3 from(-100, middle.y(), middle.z()), to(100, middle.y(), middle.z());
    const FoundOnRay ray(from, to);
    Seen seen;
    seen.m_rayDirectionInverse = ray.m_rayDirectionInverse;
    for (int d = 0; d < 3; ++d) seen.m_signs[d] = ray.m_signs[d];
    seen.m_lambda_max = ray.m_lambda_max;
    rig_.broadphase->rayTest(from, to, seen, btVector3(0, 0, 0), btVector3(0, 0, 0));
    expect(sorted(seen.proxies) == sorted(oracle_->expected_in_box(from, to)), "rayTest");
  }

  void compare_plane() {
    const btVector3 normal(1, 0, 0);
    const btScalar offset = -any()->m_aabbMax.x();
    Seen seen;
    {
      const Failures come(true);
      ours_->planesTest(&normal, &offset, 1, seen);
    }
    expect(sorted(seen.proxies) ==
               sorted(oracle_->expected_in_box(btVector3(-offset, -100, -100), btVector3(100, 100, 100))),
           "planesTest");
  }

  btHashedOverlappingPairCache hashed_;
  btSortedOverlappingPairCache sorted_;
  FunctionFilter filter_;
  Listener listener_;
  Rig rig_;
  const Broadphase* ours_ = nullptr;
  Oracle* oracle_ = nullptr;
  std::vector<btBroadphaseProxy*> proxies_;
  Random random_{7};
  bool users_change_pairs_;
  const char* wrong_ = nullptr;
};

/// Says how it ended. Some allocations are only for later calls, or for speed, and may fail without harm; then all must
/// be right.
const char* play(const Setting& setting, std::int64_t first, std::int64_t then) {
  heap_watch::fail_at(first, then);
  const Failures wait(false);
  const char* const wrong = History(setting).run();
  heap_watch::stop_failing();
  return wrong;
}

[[noreturn]] void play_and_tell(const Setting& setting, std::int64_t first, std::int64_t then) {
  const char* const wrong = play(setting, first, then);
  std::fprintf(stderr, "%s\n", wrong == nullptr ? "finished" : wrong);
  std::_Exit(wrong == nullptr ? 0 : 1);
}

/// True if the broad-phase got through without these allocations.
bool survives(const Setting& setting, std::int64_t first, std::int64_t then) {
  bool finished = false;
  const auto ended_well = [&](int status) {
    finished = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    return finished || (WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
  };
  EXPECT_EXIT(play_and_tell(setting, first, then), ended_well, "^boxstream::bullet: out of memory\n$|^finished\n$")
      << "allocation " << first << ", then " << then;
  return finished;
}

class BulletOutOfMemory : public testing::TestWithParam<Setting> {};

/// A run that survives one failed allocation is repeated with a second one failing as well.
TEST_P(BulletOutOfMemory, EachAllocationMayFail) {
  ASSERT_STREQ(play(GetParam(), heap_watch::never, heap_watch::never), nullptr);
  const std::int64_t allocations = heap_watch::tried();
  ASSERT_GT(allocations, 50) << "hardly anything was put to the test";
  const std::int64_t step = boxstream::tests::sanitized ? 10 : 1;
  for (std::int64_t first = 0; first < allocations && !HasFailure(); first += step)
    if (survives(GetParam(), first, heap_watch::never))
      for (const std::int64_t then : {0, 1, 5}) survives(GetParam(), first, then);
}

INSTANTIATE_TEST_SUITE_P(Settings, BulletOutOfMemory, testing::ValuesIn(settings),
                         [](const auto& test) { return std::to_string(test.index); });

/// Bullet's arrays take their memory from a function of Bullet's, and do not look at what they get. Here that has a
/// ceiling.
std::size_t aligned_left = ~std::size_t{0};

void* allocate_aligned(std::size_t bytes, int alignment) {
  if (bytes > aligned_left) return nullptr;
  const auto step = static_cast<std::size_t>(alignment);
  void* const memory = std::aligned_alloc(step, (bytes + step - 1) / step * step);
  aligned_left -= malloc_usable_size(memory);
  return memory;
}

void free_aligned(void* memory) {
  if (memory != nullptr) aligned_left += malloc_usable_size(memory);
  std::free(memory);
}

/// 150 cubes at 38 places, each of which meets its own place and the next ones.
int pairs_of_crowd() {
  int pairs = 0;
  for (int i = 0; i < 150; ++i)
    for (int j = i + 1; j < 150; ++j) pairs += j / 4 - i / 4 <= 1;
  return pairs;
}

void grow_below_ceiling(std::size_t bytes) {
  btAlignedAllocSetCustomAligned(allocate_aligned, free_aligned);
  Rig rig;
  for (int i = 0; i < 150; ++i) rig.create(cube(btScalar(i / 4), 0, 0));
  aligned_left = bytes;
  rig.calculate();
  aligned_left = ~std::size_t{0};
  std::fprintf(stderr, rig.pair_count() == pairs_of_crowd() ? "finished\n" : "wrong\n");
  std::_Exit(0);
}

bool aborted_or_finished(int status) {
  return (WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT) || (WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

TEST(BulletPairArray, MayNotGrow) {
  EXPECT_EXIT(grow_below_ceiling(0), testing::KilledBySignal(SIGABRT), "^boxstream::bullet: out of memory\n$");
  for (std::size_t bytes = 1000; bytes < 200000; bytes += bytes / 2)
    EXPECT_EXIT(grow_below_ceiling(bytes), aborted_or_finished, "^boxstream::bullet: out of memory\n$|^finished\n$")
        << bytes << " bytes";
  EXPECT_EXIT(grow_below_ceiling(1 << 20), testing::ExitedWithCode(0), "^finished\n$");
}

TEST(BulletMemory, AnEmptyBroadphaseGivesAllBack) {
  Broadphase broadphase;
  btCollisionObject object;
  btDefaultCollisionConfiguration config;
  btCollisionDispatcher dispatcher(&config);
  const std::int64_t before = heap_watch::live_bytes();
  for (int round = 0; round < 2; ++round) {
    std::vector<btBroadphaseProxy*> proxies;
    const auto box_at = [](int i, btScalar y) { return btVector3(btScalar(i) / 4, y, 0); };
    for (int i = 0; i < 1500; ++i)
      proxies.push_back(
          broadphase.createProxy(box_at(i, 0), box_at(i, 0) + btVector3(1, 1, 1), 0, &object, 1, -1, &dispatcher));
    for (int frame = 0; frame < 20; ++frame) {
      for (int i = 0; i < 1500; i += 1 + frame % 7) {
        const btVector3 at = box_at(i, btScalar(frame) / 50);
        broadphase.setAabb(proxies[std::size_t(i)], at, at + btVector3(1, 1, 1), &dispatcher);
      }
      broadphase.calculateOverlappingPairs(&dispatcher);
    }
    EXPECT_GT(heap_watch::live_bytes() - before, 100000);
    for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, &dispatcher);
    broadphase.calculateOverlappingPairs(&dispatcher);
    broadphase.resetPool(&dispatcher);
    std::vector<btBroadphaseProxy*>().swap(proxies);
    EXPECT_LE(heap_watch::live_bytes() - before, 1024);
    broadphase.validate();
  }
}

/// As the header states them. The array of pairs is Bullet's, which allocates by itself: it has 32 bytes a pair.
TEST(BulletMemory, OfProxiesAndPairs) {
  constexpr std::size_t count = 4000;
  btDefaultCollisionConfiguration config;
  btCollisionDispatcher dispatcher(&config);
  for (const int reach : {0, 6}) {
    std::vector<btBroadphaseProxy*> proxies(count);
    const std::int64_t before = heap_watch::live_bytes();
    Broadphase broadphase;
    const auto corner = [](std::size_t i, int frame) {
      return btVector3(btScalar(i % 100) + btScalar(frame % 2) / 8, btScalar(2 * (i / 100)), 0);
    };
    const btVector3 size(btScalar(reach) + btScalar(0.5), 1, 1);
    for (std::size_t i = 0; i < count; ++i)
      proxies[i] = broadphase.createProxy(corner(i, 0), corner(i, 0) + size, 0, nullptr, 1, -1, &dispatcher);
    for (int frame = 0; frame < 30; ++frame) {
      for (std::size_t i = 0; i < count; i += frame % 3 == 0 ? 1 : 50)
        broadphase.setAabb(proxies[i], corner(i, frame), corner(i, frame) + size, &dispatcher);
      broadphase.calculateOverlappingPairs(&dispatcher);
    }
    const auto pairs = double(broadphase.getOverlappingPairCache()->getNumOverlappingPairs());
    const double used = double(heap_watch::live_bytes() - before);
    broadphase.shrink_to_fit();
    const double left = double(heap_watch::live_bytes() - before);
    const bool is_double = sizeof(btScalar) == 8;
    EXPECT_LT(used, (is_double ? 1000 : 750) * double(count) + 28 * pairs);
    EXPECT_LT(left, (is_double ? 390 : 270) * double(count) + 8.1 * pairs);
    broadphase.validate();
    EXPECT_EQ(double(broadphase.getOverlappingPairCache()->getNumOverlappingPairs()), pairs);
    for (std::size_t i = 0; i < count; ++i)
      broadphase.setAabb(proxies[i], corner(i, 7), corner(i, 7) + size, &dispatcher);
    broadphase.calculateOverlappingPairs(&dispatcher);
    broadphase.validate();
  }
}

/// Where a few come and go, the World does not hear of them.
TEST(BulletMemory, ComingAndGoingTakesNoMore) {
  struct Count final : btBroadphaseAabbCallback {
    bool process(const btBroadphaseProxy*) override { return ++found > 0; }
    int found = 0;
  };
  for (const bool calculates : {false, true}) {
    Broadphase broadphase;
    const btVector3 one(1, 1, 1);
    std::vector<btBroadphaseProxy*> proxies;
    std::int64_t before = 0;
    for (int turn = 0; turn < 20000; ++turn) {
      if (turn == 1000) before = heap_watch::live_bytes();
      const btVector3 at(btScalar(2 * (turn % 5)), 0, 0);
      proxies.push_back(broadphase.createProxy(at, at + one, 0, nullptr, 1, -1, nullptr));
      if (calculates) broadphase.calculateOverlappingPairs(nullptr);
      broadphase.setAabb(proxies.front(), at - one, at, nullptr);
      Count count;
      broadphase.aabbTest(at, at + one, count);
      EXPECT_GT(count.found, 0);
      if (proxies.size() < 4) continue;
      const auto gone = proxies.begin() + turn % 4;
      broadphase.destroyProxy(*gone, nullptr);
      proxies.erase(gone);
    }
    EXPECT_LE(heap_watch::live_bytes(), before + 1024) << calculates;
    broadphase.validate();
    for (btBroadphaseProxy* proxy : proxies) broadphase.destroyProxy(proxy, nullptr);
  }
}

/// Of the adapter; the list of proxies that each has is Bullet's in both cases.
TEST(BulletMemory, AFewObjectsTakeLittle) {
  const std::int64_t before = heap_watch::live_bytes();
  const auto broadphase = std::make_unique<Broadphase>();
  for (int i = 0; i < 4; ++i) {
    const btVector3 at(btScalar(3 * i), 0, 0);
    broadphase->createProxy(at, at + btVector3(1, 1, 1), 0, nullptr, 1, -1, nullptr);
  }
  EXPECT_LT(heap_watch::live_bytes() - before, 20 * 1024);
}

}  // namespace
}  // namespace boxstream::bullet_test
