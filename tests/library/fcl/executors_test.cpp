// SPDX-License-Identifier: MIT
// Executors that do other work while they wait: queries within the search of another query, on the same thread, on its
// stack or beside it. A lock, or anything else to wait for, would deadlock.
#include <stdexcept>

#include "fibres.hpp"
#include "helping_executor.hpp"
#include "support.hpp"

#ifdef BOXSTREAM_HAS_TBB
#include <boxstream/tbb.hpp>
#endif

namespace boxstream::fcl_test {
namespace {

template <class S>
struct Executors : ::testing::Test {};
TYPED_TEST_SUITE(Executors, Scalars);

/// Large enough that a search is shared out.
template <class S>
const Scene<S>& large_scene() {
  static const Scene<S> scene = [] {
    std::mt19937 random(61);
    return Scene<S>(random_cubes<S>(60000, 1, random));
  }();
  return scene;
}

template <class S>
const Calls& pairs_of_large_scene() {
  static const Calls pairs = [] {
    Manager<S> alone;
    alone.registerObjects(large_scene<S>().pointers());
    return collide<S>(alone);
  }();
  return pairs;
}

TYPED_TEST(Executors, QueriesWithinTheSearchOfAQuery) {
  using S = TypeParam;
  tests::HelpingExecutor executor;
  Manager<S> manager(&executor), other(&executor);
  std::vector<Object<S>*> objects = large_scene<S>().pointers();
  manager.registerObjects(objects);
  other.registerObjects(objects);
  std::vector<Calls> answers(5);
  Calls one;
  for (int round = 0; round < 2; ++round) {
    // Each but the last begins within the search of another, some deeper, some of another manager.
    for (const std::size_t i : {1u, 2u, 3u, 4u})
      executor.add([&, i] { answers[i] = collide<S>(i % 2 == 0 ? manager : other); });
    executor.add([&] { one = collide<S>(manager, *objects[7]); });
    answers[0] = collide<S>(manager);
    for (const Calls& calls : answers) EXPECT_CALLS(calls, pairs_of_large_scene<S>());
    EXPECT_CALLS(one, collide<S>(manager, *objects[7]));
    EXPECT_GE(executor.deepest(), 2U);
    for (Manager<S>* each : {&manager, &other}) {
      ASSERT_NO_THROW(each->validate());
      each->clear();  // all anew
      each->registerObjects(objects);
    }
  }
}

TYPED_TEST(Executors, AQueryThatThrowsWithinTheSearchOfAnother) {
  using S = TypeParam;
  tests::HelpingExecutor executor;
  Manager<S> manager(&executor);
  manager.registerObjects(large_scene<S>().pointers());
  int left = 10000;
  executor.add([&] {
    const auto fail = [](Object<S>*, Object<S>*, void* data) {
      if (--*static_cast<int*>(data) == 0) throw std::logic_error("narrow phase");
      return false;
    };
    EXPECT_THROW(manager.collide(&left, fail), std::logic_error);
  });
  EXPECT_CALLS(collide<S>(manager), pairs_of_large_scene<S>());
  EXPECT_EQ(left, 0);
  EXPECT_CALLS(collide<S>(manager), pairs_of_large_scene<S>());
}

/// Fails at first, as one does that cannot start its threads.
class FailingExecutor : public Executor {
 public:
  unsigned concurrency() const override { return 4; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    if (++loops == 1) throw std::runtime_error("no threads");
    for (std::size_t i = 0; i < count; ++i) task(i);
  }
  int loops = 0;
};

TYPED_TEST(Executors, AfterASearchThatFailedTheNextHasTheExecutor) {
  using S = TypeParam;
  FailingExecutor executor;
  Manager<S> manager(&executor);
  manager.registerObjects(large_scene<S>().pointers());
  EXPECT_THROW(collide<S>(manager), std::runtime_error);
  EXPECT_EQ(executor.loops, 1);
  EXPECT_CALLS(collide<S>(manager), pairs_of_large_scene<S>());
  EXPECT_GT(executor.loops, 1);
}

#ifdef BOXSTREAM_HAS_TBB

/// As tasks of the scheduler that the manager uses itself: a thread that waits takes up the next of them.
TYPED_TEST(Executors, QueriesAsTasksOfTheirExecutor) {
  using S = TypeParam;
  TbbExecutor executor(4);
  Manager<S> manager(&executor);
  manager.registerObjects(large_scene<S>().pointers());
  std::vector<Calls> answers(12);
  executor.parallel_for(answers.size(), [&](std::size_t i) { answers[i] = collide<S>(manager); });
  for (const Calls& calls : answers) EXPECT_CALLS(calls, pairs_of_large_scene<S>());
}

#endif

#if !defined(__SANITIZE_THREAD__)  // which knows no fibres

TYPED_TEST(Executors, QueriesOnFibresOfOneThread) {
  using S = TypeParam;
  tests::Fibres fibres;
  tests::FibreExecutor executor(fibres);
  Manager<S> manager(&executor);
  manager.registerObjects(large_scene<S>().pointers());
  std::vector<Calls> answers(3);
  for (Calls& calls : answers) fibres.add([&] { calls = collide<S>(manager); });
  fibres.run();
  EXPECT_GT(fibres.yields(), 0U);
  for (const Calls& calls : answers) EXPECT_CALLS(calls, pairs_of_large_scene<S>());
}

/// Callbacks that yield: several queries are half way at once, and end in another order than they began.
TYPED_TEST(Executors, CallbacksOnFibresOfOneThread) {
  using S = TypeParam;
  std::mt19937 random(62);
  Scene<S> scene(random_cubes<S>(400, 6, random));
  Manager<S> manager, other;
  manager.registerObjects(scene.pointers());
  for (std::size_t i = 0; i < 200; ++i) other.registerObject(&scene[2 * i]);
  struct Yielding {
    tests::Fibres& fibres;
    Calls calls = {};
    static bool on_pair(Object<S>* a, Object<S>* b, void* data) {
      Yielding& self = *static_cast<Yielding*>(data);
      self.fibres.yield();
      return record<S>(a, b, &self.calls);
    }
    static bool on_distance(Object<S>* a, Object<S>* b, void* data, S& dist) {
      dist = S(0.5);
      return on_pair(a, b, data);
    }
  };
  const auto ask = [&](std::size_t which, Yielding& how) {
    Object<S>& one = scene[which];
    switch (which % 6) {
      case 0:
        return manager.collide(&how, Yielding::on_pair);
      case 1:
        return manager.collide(&one, &how, Yielding::on_pair);
      case 2:
        return manager.collide(&other, &how, Yielding::on_pair);
      case 3:
        return manager.distance(&how, Yielding::on_distance);
      case 4:
        return manager.distance(&one, &how, Yielding::on_distance);
      default:
        return manager.distance(&other, &how, Yielding::on_distance);
    }
  };
  tests::Fibres fibres;
  std::vector<Yielding> answers(24, Yielding{fibres}), alone = answers;
  for (std::size_t i = 0; i < alone.size(); ++i) ask(i, alone[i]);
  for (std::size_t i = 0; i < answers.size(); ++i) fibres.add([&, i] { ask(i, answers[i]); });
  fibres.run();
  for (std::size_t i = 0; i < answers.size(); ++i)
    EXPECT_CALLS(in_any_order(answers[i].calls), in_any_order(alone[i].calls));
}

#endif

}  // namespace
}  // namespace boxstream::fcl_test
