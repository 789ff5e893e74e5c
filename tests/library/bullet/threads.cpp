// SPDX-License-Identifier: MIT
// Section 8 of the contract: queries from many threads, the first of them with changes pending.
#include <boxstream/bullet.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <thread>

#include "on_all_threads.hpp"
#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

using boxstream::tests::on_all_threads;
using boxstream::tests::thread_count;

struct Question {
  Box box;
  btVector3 from, to;
};

struct Answer {
  std::vector<const btBroadphaseProxy*> in_box, on_ray;
  bool operator==(const Answer& other) const { return in_box == other.in_box && on_ray == other.on_ray; }
};

Answer answer(Rig& rig, const Question& q) {
  return {rig.in_box(q.box), rig.on_ray(q.from, q.to)};
}

std::vector<Question> questions(std::uint64_t start, int n) {
  Random random(start);
  std::vector<Question> asked;
  for (int i = 0; i < n; ++i) {
    const btVector3 p = random.vector(-8, 8), from = random.vector(-12, 12), to = random.vector(-12, 12);
    asked.push_back({cube(p.x(), p.y(), p.z(), random.real(0, 3)), from, to});
  }
  return asked;
}

std::vector<btBroadphaseProxy*> fill(Rig& rig, int n) {
  Random random(80);
  std::vector<btBroadphaseProxy*> proxies;
  for (int i = 0; i < n; ++i) {
    const btVector3 p = random.vector(-8, 8);
    proxies.push_back(rig.create(cube(p.x(), p.y(), p.z())));
  }
  return proxies;
}

/// Each round changes boxes and then asks from all threads at once; `twin` gets the same changes and is asked by one.
void ask_right_after_changes(btOverlappingPairCache* cache, btOverlappingPairCache* twin_cache) {
  Rig rig(Kind::subject, cache), twin(Kind::subject, twin_cache);
  std::vector<btBroadphaseProxy*> proxies = fill(rig, 400), twins = fill(twin, 400);
  const std::vector<Question> asked = questions(81, 12);
  Random random(82);
  for (int round = 0; round < 25; ++round) {
    for (int i = 0; i < 60; ++i) {
      const std::size_t which = static_cast<std::size_t>(random.below(static_cast<int>(proxies.size())));
      const btVector3 p = random.vector(-8, 8);
      rig.move(proxies[which], cube(p.x(), p.y(), p.z()));
      twin.move(twins[which], cube(p.x(), p.y(), p.z()));
    }
    if (round % 3 == 0) {
      rig.destroy(proxies.back());
      twin.destroy(twins.back());
      proxies.pop_back();
      twins.pop_back();
    }
    if (round % 4 == 1) {
      proxies.push_back(rig.create(cube(0, 0, 0)));
      twins.push_back(twin.create(cube(0, 0, 0)));
    }
    if (round % 5 == 2) rig.calculate();
    std::array<std::vector<Answer>, thread_count> answers;
    on_all_threads([&](int t) {
      for (const Question& q : asked) answers[static_cast<std::size_t>(t)].push_back(answer(rig, q));
    });
    for (int t = 1; t < thread_count; ++t)
      ASSERT_EQ(answers[static_cast<std::size_t>(t)], answers[0]) << "thread " << t;
    for (std::size_t i = 0; i < asked.size(); ++i) {  // the twin's proxies have other addresses, so compare uids
      const Answer alone = answer(twin, asked[i]);
      const auto uids = [](const std::vector<const btBroadphaseProxy*>& found) {
        std::vector<int> ids;
        for (const btBroadphaseProxy* proxy : found) ids.push_back(proxy->m_uniqueId);
        return sorted(ids);
      };
      ASSERT_EQ(uids(answers[0][i].in_box), uids(alone.in_box)) << "round " << round;
      ASSERT_EQ(uids(answers[0][i].on_ray), uids(alone.on_ray)) << "round " << round;
    }
  }
}

TEST(BulletThreads, T3_FirstQueriesAfterSetAabbComeFromEightThreads) {
  ask_right_after_changes(nullptr, nullptr);
}

TEST(BulletThreads, T3_WithAnExternalCache) {
  btHashedOverlappingPairCache cache, twin_cache;
  ask_right_after_changes(&cache, &twin_cache);
}

TEST(BulletThreads, T1_ReadsOfPairCacheBesideQueries) {
  // What the continuous collision callbacks of a multi-threaded world do, all at once.
  Rig rig;
  std::vector<btBroadphaseProxy*> proxies = fill(rig, 300);
  rig.calculate();
  for (btBroadphaseProxy* proxy : proxies) {
    const btVector3 step(btScalar(0.1), 0, 0);
    rig.move(proxy, {proxy->m_aabbMin + step, proxy->m_aabbMax + step});
  }
  const btOverlappingPairCache* cache = rig.broadphase->getOverlappingPairCache();
  const int pairs = cache->getNumOverlappingPairs();
  std::atomic<long> accepted{0};
  on_all_threads([&](int t) {
    for (int i = 0; i < 60; ++i) {
      btOverlappingPairCache* mine = rig.broadphase->getOverlappingPairCache();
      EXPECT_EQ(mine, cache);
      EXPECT_EQ(mine->getOverlapFilterCallback(), nullptr);
      const std::size_t a = static_cast<std::size_t>(t * 30 + i), b = a + 1;
      accepted += mine->needsBroadphaseCollision(proxies[a], proxies[b]);
      EXPECT_FALSE(rig.in_box({proxies[a]->m_aabbMin, proxies[a]->m_aabbMax}).empty());
      btVector3 lo, hi;
      rig.broadphase->getAabb(proxies[a], lo, hi);
      EXPECT_EQ(lo, proxies[a]->m_aabbMin);
      EXPECT_EQ(mine->getNumOverlappingPairs(), pairs);
    }
  });
  EXPECT_EQ(accepted, thread_count * 60);
}

TEST(BulletThreads, S8_AlgorithmsWrittenInParallelOverDistinctPairs) {
  // The multi-threaded dispatcher walks the raw array, each thread a range of it, and writes m_algorithm.
  Rig rig;
  fill(rig, 600);
  rig.calculate();
  const int pairs = rig.pair_count();
  ASSERT_GT(pairs, 200);
  btBroadphasePair* first = rig.cache().getOverlappingPairArrayPtr();
  std::vector<char> marks(static_cast<std::size_t>(pairs));
  on_all_threads([&](int t) {
    for (int i = pairs * t / thread_count; i < pairs * (t + 1) / thread_count; ++i) {
      first[i].m_algorithm = reinterpret_cast<btCollisionAlgorithm*>(&marks[static_cast<std::size_t>(i)]);
      rig.in_box({first[i].m_pProxy0->m_aabbMin, first[i].m_pProxy0->m_aabbMax});
    }
  });
  for (int i = 0; i < pairs; ++i) {
    ASSERT_EQ(first[i].m_algorithm, reinterpret_cast<btCollisionAlgorithm*>(&marks[static_cast<std::size_t>(i)]));
    first[i].m_algorithm = nullptr;
  }
}

TEST(BulletThreads, Q10_NestedQueriesOnEveryThread) {
  Rig rig;
  std::vector<btBroadphaseProxy*> proxies = fill(rig, 200);
  rig.move(proxies[0], cube(0, 0, 0));  // pending
  std::array<long, thread_count> nested{};
  on_all_threads([&](int t) {
    Found outer;
    outer.also = [&](const btBroadphaseProxy* proxy) {
      const auto inner = rig.on_ray(proxy->m_aabbMin - btVector3(1, 1, 1), proxy->m_aabbMax);
      EXPECT_TRUE(std::binary_search(inner.begin(), inner.end(), proxy));
      ++nested[static_cast<std::size_t>(t)];
    };
    const Box all = cube(0, 0, 0, 20);
    rig.broadphase->aabbTest(all.lo, all.hi, outer);
  });
  for (const long n : nested) EXPECT_EQ(n, 200);
}

TEST(BulletThreads, S8_ChangesMayComeFromAnotherThreadEachTime) {
  auto* oracle = new Oracle(make_broadphase(Kind::subject));
  Rig rig;
  rig.broadphase.reset(oracle);
  std::vector<btBroadphaseProxy*> proxies = fill(rig, 150);
  Random random(85);
  for (int frame = 0; frame < 20; ++frame) {
    std::thread([&] {
      for (btBroadphaseProxy* proxy : proxies) {
        const btVector3 p = random.vector(-5, 5);
        rig.move(proxy, cube(p.x(), p.y(), p.z()));
      }
    }).join();
    std::thread([&] { rig.calculate(); }).join();
    ASSERT_TRUE(oracle->check(Rule::exact)) << "frame " << frame;
  }
}

/// Threads that are started for each loop: slow, and as parallel as it gets.
class ThreadsForEachLoop : public boxstream::Executor {
 public:
  unsigned concurrency() const override { return 4; }
  void parallel_for(std::size_t count, boxstream::FunctionRef<void(std::size_t)> task) override {
    ++loops;
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < concurrency(); ++t)
      threads.emplace_back([&] {
        for (std::size_t i = next++; i < count; i = next++) task(i);
      });
    for (std::thread& thread : threads) thread.join();
  }
  int loops = 0;
};

TEST(BulletThreads, P13_OrderDoesNotDependOnTheExecutor) {
  ThreadsForEachLoop executor;
  std::vector<std::vector<UidPair>> runs[2];
  for (int r = 0; r < 2; ++r) {
    boxstream::bullet::Options options;
    if (r == 1) options.executor = &executor;
    Rig rig;
    rig.broadphase = std::make_unique<boxstream::bullet::Broadphase>(options);
    Random random(86);
    std::vector<btBroadphaseProxy*> proxies = fill(rig, 20000);  // below some 16 000 nothing is worth a task
    for (int frame = 0; frame < 4; ++frame) {
      for (btBroadphaseProxy* proxy : proxies) {
        const btVector3 p = random.vector(-22, 22);
        rig.move(proxy, cube(p.x(), p.y(), p.z()));
      }
      rig.calculate();
      runs[r].push_back(rig.pairs());
    }
  }
  EXPECT_GT(runs[0][0].size(), 5000u);
  EXPECT_EQ(runs[0], runs[1]);
  EXPECT_GE(executor.loops, 4);
}

TEST(BulletThreads, TwoBroadphasesAtOnceShareNothing) {
  const auto run = [](std::uint64_t start) {
    Rig rig;
    std::vector<std::vector<UidPair>> pairs;
    std::vector<btBroadphaseProxy*> proxies = fill(rig, 400);
    Random random(start);
    for (int frame = 0; frame < 15; ++frame) {
      for (btBroadphaseProxy* proxy : proxies) {
        const btVector3 p = random.vector(-6, 6);
        rig.move(proxy, cube(p.x(), p.y(), p.z()));
      }
      rig.calculate();
      pairs.push_back(rig.pairs());
    }
    return pairs;
  };
  const auto first = run(87), second = run(88);
  EXPECT_GT(first.back().size(), 100u);
  std::vector<std::vector<UidPair>> beside_first, beside_second;
  std::thread a([&] { beside_first = run(87); }), b([&] { beside_second = run(88); });
  a.join();
  b.join();
  EXPECT_EQ(beside_first, first);
  EXPECT_EQ(beside_second, second);
}

TEST(BulletThreads, T4_CallbacksRunOnTheCallingThread) {
  Rig rig;
  std::vector<std::thread::id> callers;
  GhostLog ghost;
  ghost.on_event = [&](const GhostLog::Event&) {
    callers.push_back(std::this_thread::get_id());
    rig.in_box(cube(0, 0, 0));  // would deadlock if a lock were held
  };
  FunctionFilter filter([&](auto, auto) {
    callers.push_back(std::this_thread::get_id());
    rig.in_box(cube(0, 0, 0));
    return true;
  });
  rig.cache().setInternalGhostPairCallback(&ghost);
  rig.cache().setOverlapFilterCallback(&filter);
  std::vector<btBroadphaseProxy*> proxies = fill(rig, 300);
  std::thread::id caller;
  std::thread([&] {
    caller = std::this_thread::get_id();
    rig.calculate();
    rig.destroy(proxies[0]);
  }).join();
  EXPECT_GT(callers.size(), 100u);
  for (const std::thread::id& id : callers) EXPECT_EQ(id, caller);
  rig.cache().setInternalGhostPairCallback(nullptr);
  rig.cache().setOverlapFilterCallback(nullptr);
}

}  // namespace
}  // namespace boxstream::bullet_test
