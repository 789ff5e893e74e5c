// SPDX-License-Identifier: MIT
// The Executor over btITaskScheduler. Debian's Bullet has no scheduler with threads, so these behave like Bullet's.
#include <boxstream/bullet/executor.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/search_record.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {
namespace {

using boxstream::Aabb;
using boxstream::Detector;
using boxstream::Pair;
using boxstream::bullet::TaskSchedulerExecutor;

/// As Bullet's default one: a loop that comes while another runs is run by its caller alone, in one piece.
class Threads : public btITaskScheduler {
 public:
  explicit Threads(int threads) : btITaskScheduler("threads of the tests"), threads_(threads) {}
  int getMaxNumThreads() const override { return 64; }
  int getNumThreads() const override { return threads_; }
  void setNumThreads(int threads) override { threads_ = threads; }
  btScalar parallelSum(int begin, int end, int, const btIParallelSumBody& body) override {
    return body.sumLoop(begin, end);
  }
  void parallelFor(int begin, int end, int grain, const btIParallelForBody& body) override {
    ++loops;
    if (busy_.exchange(true)) return body.forLoop(begin, end);
    std::vector<std::thread> started;
    for (int i = begin + grain; i < end; i += grain)
      started.emplace_back([&, i] { body.forLoop(i, std::min(i + grain, end)); });
    body.forLoop(begin, std::min(begin + grain, end));
    for (std::thread& thread : started) thread.join();
    busy_ = false;
  }

  std::atomic<int> loops{0};

 private:
  int threads_;
  std::atomic<bool> busy_{false};
};

/// Returns while its threads are still at work, as Bullet's default one does after a tenth of a second.
class Impatient final : public Threads {
 public:
  Impatient() : Threads(3) {}
  ~Impatient() override {
    for (std::thread& thread : started_) thread.join();
  }
  void parallelFor(int begin, int end, int, const btIParallelForBody& body) override {
    for (int i = begin; i < end; ++i)
      started_.emplace_back([&body, i] {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
        body.forLoop(i, i + 1);
      });
  }

 private:
  std::vector<std::thread> started_;
};

/// The one that is set is global to the process.
class WithScheduler {
 public:
  explicit WithScheduler(btITaskScheduler* scheduler) : before_(btGetTaskScheduler()) { btSetTaskScheduler(scheduler); }
  ~WithScheduler() { btSetTaskScheduler(before_); }

 private:
  btITaskScheduler* before_;
};

void expect_each_task_once(TaskSchedulerExecutor& executor) {
  for (const std::size_t count : {0, 1, 2, 3, 7, 3000}) {
    std::vector<std::atomic<int>> runs(count);
    executor.parallel_for(count, [&](std::size_t i) { ++runs[i]; });
    EXPECT_TRUE(std::all_of(runs.begin(), runs.end(), [](const auto& n) { return n == 1; })) << count << " tasks";
  }
}

boxstream::tests::Boxes<float> boxes(int n, std::uint64_t start) {
  Random random(start);
  boxstream::tests::Boxes<float> made;
  for (int i = 0; i < n; ++i) {
    const btVector3 p = random.vector(-15, 15);
    const float x = float(p.x()), y = float(p.y()), z = float(p.z());
    made.push_back({{x, y, z}, {x + 1, y + 1, z + 1}});
  }
  return made;
}

TEST(BulletExecutor, RunsEachTaskOnce) {
  Threads threads(4);
  TaskSchedulerExecutor executor(&threads);
  expect_each_task_once(executor);
  EXPECT_EQ(threads.loops, 4);  // none for no task, nor for one
  TaskSchedulerExecutor sequential(btGetSequentialTaskScheduler());
  EXPECT_EQ(sequential.concurrency(), 1u);
  expect_each_task_once(sequential);
}

TEST(BulletExecutor, HasAsManyThreadsAsTheSchedulerNow) {
  Threads threads(4);
  const TaskSchedulerExecutor executor(&threads);
  EXPECT_EQ(executor.concurrency(), 4u);
  threads.setNumThreads(2);
  EXPECT_EQ(executor.concurrency(), 2u);
  threads.setNumThreads(0);  // as before its first setNumThreads
  EXPECT_EQ(executor.concurrency(), 1u);
}

TEST(BulletExecutor, WithoutOneOfItsOwnTakesTheOneThatIsSet) {
  Threads first(2), second(3);
  TaskSchedulerExecutor executor;
  const WithScheduler none(nullptr);
  EXPECT_EQ(executor.concurrency(), 1u);
  expect_each_task_once(executor);
  const WithScheduler one(&first);
  EXPECT_EQ(executor.concurrency(), 2u);
  const WithScheduler other(&second);
  EXPECT_EQ(executor.concurrency(), 3u);
  expect_each_task_once(executor);
  EXPECT_EQ(first.loops, 0);
  EXPECT_EQ(second.loops, 4);
}

/// This Bullet's own, whatever it was built with.
TEST(BulletExecutor, RunsOnBulletsDefaultScheduler) {
  const std::unique_ptr<btITaskScheduler> scheduler(btCreateDefaultTaskScheduler());
  const WithScheduler set(scheduler.get());
  TaskSchedulerExecutor executor;
  expect_each_task_once(executor);
}

TEST(BulletExecutor, WaitsForASchedulerThatDoesNot) {
  Impatient impatient;
  TaskSchedulerExecutor executor(&impatient);
  expect_each_task_once(executor);
}

/// Parallel work from within a loop of the same scheduler, as in a world that is stepped by a task.
TEST(BulletExecutor, SearchesFromWithinALoopOfItsScheduler) {
  const auto all = boxes(20000, 91);
  std::vector<Pair> expected;
  Detector().find_pairs(all, expected);
  Threads threads(3);
  TaskSchedulerExecutor executor(&threads);
  std::vector<std::vector<Pair>> found(6);
  executor.parallel_for(found.size(), [&](std::size_t i) { Detector({&executor}).find_pairs(all, found[i]); });
  EXPECT_GT(threads.loops, 1);
  for (const auto& pairs : found) EXPECT_EQ(pairs, expected);
}

TEST(BulletExecutor, ResultsAreThoseOfOneThread) {
  const auto a = boxes(30000, 92), b = boxes(20000, 93);
  Detector serial;
  const auto expected = boxstream::tests::search_all<float>(serial, a, b);
  for (const int n : {1, 2, 5}) {
    Threads threads(n);
    TaskSchedulerExecutor executor(&threads);
    Detector detector({&executor});
    boxstream::tests::expect_same_search(boxstream::tests::search_all<float>(detector, a, b), expected);
    EXPECT_EQ(threads.loops > 0, n > 1);
  }
}

TEST(BulletExecutor, SearchesAtTheSameTime) {
  const auto all = boxes(20000, 94);
  std::vector<Pair> expected;
  Detector().find_pairs(all, expected);
  Threads threads(3);
  TaskSchedulerExecutor executor(&threads);
  std::vector<std::vector<Pair>> found(3);
  std::vector<std::thread> callers;
  for (auto& pairs : found) callers.emplace_back([&] { Detector({&executor}).find_pairs(all, pairs); });
  for (std::thread& caller : callers) caller.join();
  for (const auto& pairs : found) EXPECT_EQ(pairs, expected);
}

TEST(BulletExecutor, ServesOnAfterASinkThrew) {
  const auto all = boxes(20000, 95);
  Threads threads(3);
  TaskSchedulerExecutor executor(&threads);
  Detector detector({&executor});
  std::vector<Pair> found, expected;
  Detector().find_pairs(all, expected);
  const auto fail = [](boxstream::Span<const Pair>) -> bool { throw std::runtime_error("enough"); };
  EXPECT_THROW(detector.stream_pairs(all, fail), std::runtime_error);
  detector.find_pairs(all, found);
  EXPECT_EQ(found, expected);
}

TEST(BulletExecutor, PairsOfABroadphaseAreThoseOfOneThread) {
  const auto run = [](boxstream::Executor* executor) {
    Rig rig;
    boxstream::bullet::Options options;
    options.executor = executor;
    rig.broadphase = std::make_unique<boxstream::bullet::Broadphase>(options);
    Random random(96);
    std::vector<btBroadphaseProxy*> proxies;
    for (int i = 0; i < 20000; ++i) proxies.push_back(rig.create(cube(0, 0, 0)));
    std::vector<std::vector<UidPair>> pairs;
    for (int frame = 0; frame < 3; ++frame) {
      for (btBroadphaseProxy* proxy : proxies) {
        const btVector3 p = random.vector(-22, 22);
        rig.move(proxy, cube(p.x(), p.y(), p.z()));
      }
      rig.calculate();
      pairs.push_back(rig.pairs());
    }
    return pairs;
  };
  Threads threads(3);
  TaskSchedulerExecutor executor(&threads);
  const auto alone = run(nullptr);
  EXPECT_GT(alone[0].size(), 5000u);
  EXPECT_EQ(run(&executor), alone);
  EXPECT_GE(threads.loops, 3);
}

}  // namespace
}  // namespace boxstream::bullet_test
