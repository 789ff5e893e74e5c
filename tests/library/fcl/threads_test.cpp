// SPDX-License-Identifier: MIT
// C6: queries from many threads at once, the first of them right after a change, with neither setup nor update.
#include <atomic>
#include <thread>

#include "on_all_threads.hpp"
#include "support.hpp"

namespace boxstream::fcl_test {
namespace {

using tests::on_all_threads;
using tests::thread_count;

template <class S>
struct Threads : ::testing::Test {};
TYPED_TEST_SUITE(Threads, Scalars);

struct Answers {
  Calls self, one, cross, far;
  friend bool operator==(const Answers& x, const Answers& y) {
    return x.self == y.self && x.one == y.one && x.cross == y.cross && x.far == y.far;
  }
};

/// Each kind of query, beginning with another one on each thread.
template <class S>
Answers ask(const Manager<S>& manager, Manager<S>& other, BoxObject<S>& query, int first) {
  Answers answers;
  for (int i = 0; i < 4; ++i) switch ((first + i) % 4) {
      case 0:
        answers.self = collide<S>(manager);
        break;
      case 1:
        answers.one = collide<S>(manager, query);
        break;
      case 2:
        answers.cross = collide<S>(manager, other);
        break;
      default:
        manager.distance(&query, &answers.far, record_distance<S>);
    }
  return answers;
}

TYPED_TEST(Threads, C6_RightAfterEveryKindOfChange) {
  using S = TypeParam;
  for (const std::size_t size : {20, 500}) {
    std::mt19937 random(31);
    Scene<S> scene(random_cubes<S>(size, 4, random)), others(random_cubes<S>(size / 4, 4, random));
    BoxObject<S> query(cube<S>(2, 2, 2, 1), 10000);
    Manager<S> manager, other, alone, other_alone;
    const auto everywhere = [&](auto change) {
      change(manager);
      change(alone);
    };
    const auto compare = [&](const char* when) {
      const Answers expected = ask<S>(alone, other_alone, query, 0);
      std::atomic<int> wrong{0};
      on_all_threads([&](int t) { wrong += !(ask<S>(manager, other, query, t) == expected); });
      EXPECT_EQ(wrong.load(), 0) << when;
      EXPECT_FALSE(expected.self.empty());
    };
    other.registerObjects(others.pointers());
    other_alone.registerObjects(others.pointers());
    everywhere([&](Manager<S>& m) {
      for (Object<S>* object : scene.pointers()) m.registerObject(object);
    });
    compare("after registerObject");
    for (int round = 0; round < 8; ++round) {
      const std::size_t step = round % 2 == 0 ? 1 : 10;
      const std::vector<FclBox<S>> boxes = random_cubes<S>(size, 4, random);
      for (std::size_t i = 0; i < size; i += step) scene[i].set(boxes[i]);
      everywhere([](Manager<S>& m) { m.update(); });
      compare("after update");
      everywhere([&](Manager<S>& m) { m.unregisterObject(&scene[static_cast<std::size_t>(round)]); });
      compare("after unregisterObject");
      everywhere([&](Manager<S>& m) { m.registerObject(&scene[static_cast<std::size_t>(round)]); });
      compare("after registering again");
    }
    everywhere([&](Manager<S>& m) {
      m.clear();
      m.registerObjects(scene.pointers());
    });
    compare("after clear");
  }
}

/// Callbacks that query the manager again, on every thread.
TYPED_TEST(Threads, C6_C9_QueriesWithinQueries) {
  using S = TypeParam;
  std::mt19937 random(32);
  Scene<S> scene(random_cubes<S>(300, 4, random));
  Manager<S> manager;
  manager.registerObjects(scene.pointers());
  struct Nested {
    const Manager<S>* manager;
    std::size_t calls = 0, inner = 0;

    static bool on_pair(Object<S>*, Object<S>*, void* data) {
      Nested& nested = *static_cast<Nested*>(data);
      if (nested.calls++ % 8 == 0) nested.inner += collide<S>(*nested.manager).size();
      return false;
    }
    static bool on_distance(Object<S>* a, Object<S>* b, void* data, S& dist) {
      dist = S(0.01);
      return on_pair(a, b, data);
    }
  };
  std::size_t expected = 0;
  for (int round = 0; round < 3; ++round) {
    manager.update(&scene[0]);
    scene[0].set(cube<S>(S(1 + round), 1, 1));
    manager.update();
    std::vector<std::size_t> inner(thread_count);
    on_all_threads([&](int t) {
      Nested nested{&manager};
      if (t % 2 == 0)
        manager.distance(&nested, Nested::on_distance);
      else
        manager.collide(&nested, Nested::on_pair);
      inner[static_cast<std::size_t>(t)] = nested.inner;
    });
    expected = inner[1];
    EXPECT_GT(expected, 100U);
    for (std::size_t t = 1; t < inner.size(); t += 2) EXPECT_EQ(inner[t], expected);
    for (std::size_t t = 2; t < inner.size(); t += 2) EXPECT_EQ(inner[t], inner[0]);
  }
}

TYPED_TEST(Threads, TwoManagersAtOnceShareNothing) {
  using S = TypeParam;
  // FCL's objects write to the geometry that they share when they are made, so they are made before the threads.
  std::mt19937 start(35);
  Scene<S> scenes[] = {Scene<S>(random_cubes<S>(400, 4, start)), Scene<S>(random_cubes<S>(400, 4, start))};
  const auto run = [&scenes](unsigned which) {
    Scene<S>& scene = scenes[which];
    std::mt19937 random(36 + which);
    Manager<S> manager;
    manager.registerObjects(scene.pointers());
    Calls all;
    for (int frame = 0; frame < 10; ++frame) {
      const std::vector<FclBox<S>> boxes = random_cubes<S>(400, 4, random);
      for (std::size_t i = 0; i < boxes.size(); ++i) scene[i].set(boxes[i]);
      manager.update();
      for (const Calls& calls : {collide<S>(manager), collide<S>(manager, scene[7])})
        all.insert(all.end(), calls.begin(), calls.end());
    }
    return all;
  };
  const Calls first = run(0), second = run(1);
  EXPECT_GT(first.size(), 1000u);
  Calls beside_first, beside_second;
  std::thread a([&] { beside_first = run(0); }), b([&] { beside_second = run(1); });
  a.join();
  b.join();
  EXPECT_CALLS(beside_first, first);
  EXPECT_CALLS(beside_second, second);
}

/// An executor that runs everything on as many threads as it says.
class ThreadExecutor : public Executor {
 public:
  explicit ThreadExecutor(unsigned threads) : threads_(threads) {}
  unsigned concurrency() const override { return threads_; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    std::atomic<std::size_t> next{0};
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < threads_; ++t)
      threads.emplace_back([&] {
        for (std::size_t i = next++; i < count; i = next++) task(i);
      });
    for (std::thread& thread : threads) thread.join();
    ++runs;
  }
  std::atomic<int> runs{0};

 private:
  unsigned threads_;
};

TYPED_TEST(Threads, ResultsDoNotDependOnTheExecutor) {
  using S = TypeParam;
  std::mt19937 random(35);
  Scene<S> scene(random_cubes<S>(30000, 1, random));
  Manager<S> serial;
  serial.registerObjects(scene.pointers());
  const Calls expected = collide<S>(serial);
  EXPECT_GT(expected.size(), 10000U);
  ThreadExecutor executor(3);
  Manager<S> parallel(&executor);
  parallel.registerObjects(scene.pointers());
  EXPECT_CALLS(collide<S>(parallel), expected);
  EXPECT_GT(executor.runs, 0);
}

/// One of them has the executor, the others do without.
TYPED_TEST(Threads, QueriesAtOnceWithAnExecutor) {
  using S = TypeParam;
  std::mt19937 random(37);
  Scene<S> scene(random_cubes<S>(20000, 1, random));
  Manager<S> serial;
  serial.registerObjects(scene.pointers());
  ThreadExecutor executor(2);
  Manager<S> manager(&executor);
  manager.registerObjects(scene.pointers());
  for (int round = 0; round < 3; ++round) {
    const Calls expected = collide<S>(serial);
    std::atomic<int> wrong{0};
    on_all_threads([&](int) { wrong += collide<S>(manager) != expected; });
    EXPECT_EQ(wrong.load(), 0);
    for (std::size_t i = 0; i < scene.size(); i += 2)
      scene[i].set(scene[(i + 1 + random() % 9) % scene.size()].getAABB());
    for (Manager<S>* each : {&serial, &manager}) each->update();
  }
  EXPECT_GT(executor.runs, 0);
}

}  // namespace
}  // namespace boxstream::fcl_test
