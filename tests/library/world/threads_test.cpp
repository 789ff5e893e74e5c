// SPDX-License-Identifier: MIT
// Queries from many threads, the first ones after changes included. For ThreadSanitizer too.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <thread>
#include <vector>

#include <boxstream/world.hpp>

#include "core/oracle.hpp"
#include "world/core.hpp"

namespace boxstream::tests {

TEST(Threads, EightQueryAtOnceRightAfterMoves) {
  constexpr int proxies = 2000;
  constexpr unsigned threads = 8;
  World world;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(0, 40);
  const auto random_box = [&]() -> Aabb {
    const float x = place(random);
    const float y = place(random);
    const float z = place(random);
    return {{x, y, z}, {x + 1, y + 1, z + 1}};
  };
  std::vector<ProxyId> ids;
  for (int i = 0; i < proxies; ++i) ids.push_back(world.create(random_box()));

  for (int frame = 0; frame < 12; ++frame) {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (frame % 3 == 0 || i % 20 == 0) world.move(ids[i], random_box());
      boxes.push_back(world.box(ids[i]));
    }
    std::atomic<unsigned> waiting{threads};
    std::atomic<int> wrong{0};
    std::vector<std::thread> crew;
    for (unsigned t = 0; t < threads; ++t)
      crew.emplace_back([&, t] {
        --waiting;
        while (waiting != 0) std::this_thread::yield();
        for (std::size_t i = t; i < ids.size(); i += 97) {
          std::size_t found = 0;
          std::size_t expected = 0;
          for (const Aabb& box : boxes) expected += touch(box, boxes[i]);
          world.query_box(boxes[i], [&](ProxyId) { return ++found > 0; });
          wrong += found != expected;
          bool met = false;
          world.query_ray(Ray::sweep(boxes[i], {0, 0, 0}), [&](ProxyId id, float, float length) {
            met = met || id == ids[i];
            return length;
          });
          wrong += !met;
          ProxyId nearest[1];
          wrong += world.query_nearest(boxes[i].min, nearest) != 1;
          std::size_t touching = 0;
          world.query_nearest_box(boxes[i], 1, [&](ProxyId, float distance) {
            touching += distance == 0;
            return 1.0f;
          });
          wrong += touching != expected;
          std::size_t pairs = 0;
          world.nearest_pairs(1, [&](ProxyPair, float distance) {
            wrong += !(distance < 1);
            return ++pairs < 200 ? 1.0f : 0.0f;
          });
          wrong += pairs != 200;
        }
        wrong += !makes_sense(world.bounds());
      });
    for (std::thread& thread : crew) thread.join();
    ASSERT_EQ(wrong, 0);
    if (frame % 4 == 1) world.update();
  }
}

// Worlds share nothing.
TEST(Threads, TwoWorldsUpdateAtOnce) {
  const auto run = [] {
    World world;
    std::vector<ProxyId> ids;
    for (int i = 0; i < 500; ++i) ids.push_back(world.create({{float(i), 0, 0}, {float(i) + 1, 1, 1}}));
    std::uint64_t events = 0;
    for (int frame = 0; frame < 20; ++frame) {
      events += world.update().begun;
      for (std::size_t i = 0; i < ids.size(); i += 3)
        world.move(ids[i], {{0, float(frame), 0}, {1, float(frame) + 1, 1}});
    }
    return events;
  };
  const std::uint64_t expected = run();
  std::uint64_t seen[2] = {};
  std::thread a([&] { seen[0] = run(); });
  std::thread b([&] { seen[1] = run(); });
  a.join();
  b.join();
  EXPECT_EQ(seen[0], expected);
  EXPECT_EQ(seen[1], expected);
}

/// One thread for each task, soon enough that phases of an update are shared.
class ThreadEach final : public Executor {
 public:
  unsigned concurrency() const override { return 4; }
  std::uint32_t start_nanoseconds() override { return 1000; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    most_tasks = std::max(most_tasks, count);
    std::vector<std::thread> crew;
    for (std::size_t i = 0; i < count; ++i) crew.emplace_back([&task, i] { task(i); });
    for (std::thread& thread : crew) thread.join();
  }
  std::size_t most_tasks = 0;
};

// The events of an update do not depend on the executor, whichever way it searches.
TEST(Threads, ExecutorChangesNothingButTheTime) {
  constexpr std::size_t proxies = 20000;
  ThreadEach executor;
  WorldOptions with_executor;
  with_executor.executor = &executor;
  World parallel(with_executor), serial;
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(0, 30);
  const auto random_box = [&]() -> Aabb {
    const float x = place(random);
    const float y = place(random);
    const float z = place(random);
    return {{x, y, z}, {x + 1, y + 1, z + 1}};
  };
  std::vector<Aabb> boxes(proxies);
  for (Aabb& box : boxes) box = random_box();
  std::vector<ProxyId> ids(proxies);
  for (World* world : {&parallel, &serial}) world->create(boxes, {}, ids);
  const auto same = [](Span<const ProxyPair> x, Span<const ProxyPair> y) {
    return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                      [](const ProxyPair& p, const ProxyPair& q) { return p.a == q.a && p.b == q.b; });
  };
  std::size_t probed_in_parallel = 0;
  for (int frame = 0; frame < 30; ++frame) {
    if (frame == 0 || frame == 20)
      for (Aabb& box : boxes) box = random_box();
    for (std::size_t i = static_cast<std::size_t>(frame) % 5; i < proxies; i += 5)
      for (float* bound : {&boxes[i].min[1], &boxes[i].max[1]}) *bound += 0.1f;
    for (World* world : {&parallel, &serial}) EXPECT_EQ(world->move(ids, boxes), proxies);
    executor.most_tasks = 0;
    const WorldStats stats = parallel.update();
    EXPECT_EQ(serial.update().pairs, stats.pairs);
    ASSERT_TRUE(same(parallel.begun(), serial.begun())) << "frame " << frame;
    ASSERT_TRUE(same(parallel.ended(), serial.ended())) << "frame " << frame;
    if (stats.search.boxes == 0) probed_in_parallel += executor.most_tasks;
  }
  EXPECT_GT(probed_in_parallel, 0u);
}

// The same where all boxes move little, so that candidates are kept, and with one way of searching after the other.
TEST(Threads, ExecutorChangesNothingWhereAllMove) {
  constexpr std::size_t proxies = 20000;
  using detail::SearchMode;
  for (const SearchMode mode : {SearchMode::cheapest, SearchMode::all, SearchMode::candidates}) {
    ThreadEach executor;
    WorldOptions with_executor;
    with_executor.executor = &executor;
    detail::WorldCore<float> parallel(with_executor, mode), serial({}, mode);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(0, 25), step(-0.05f, 0.05f);
    std::vector<Aabb> boxes(proxies);
    for (Aabb& box : boxes)
      for (int d = 0; d < 3; ++d) {
        box.min[d] = place(random);
        box.max[d] = box.min[d] + 1;
      }
    std::vector<ProxyId> ids(proxies);
    for (auto* world : {&parallel, &serial}) world->create(boxes, {}, ids);
    std::size_t shared = 0;
    for (int frame = 0; frame < 12; ++frame) {
      for (Aabb& box : boxes)
        for (int d = 0; d < 3; ++d) {
          const float by = step(random);
          box.min[d] += by;
          box.max[d] += by;
        }
      for (auto* world : {&parallel, &serial}) world->move(ids, boxes);
      executor.most_tasks = 0;
      const WorldStats of_parallel = parallel.update(), of_serial = serial.update();
      shared += executor.most_tasks > 1;
      EXPECT_EQ(of_parallel.pairs, of_serial.pairs);
      if (mode != SearchMode::cheapest) {
        EXPECT_EQ(of_parallel.search.tests, of_serial.search.tests);
      }
      const auto same = [](Span<const ProxyPair> x, Span<const ProxyPair> y) {
        return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                          [](const ProxyPair& p, const ProxyPair& q) { return p.a == q.a && p.b == q.b; });
      };
      ASSERT_TRUE(same(parallel.begun(), serial.begun())) << "frame " << frame;
      ASSERT_TRUE(same(parallel.ended(), serial.ended())) << "frame " << frame;
    }
    EXPECT_EQ(shared, 12u);
    parallel.validate();
  }
}

}  // namespace boxstream::tests
