// SPDX-License-Identifier: MIT
// What sinks and tasks throw ends where it is caught, however long Detectors, Worlds and Executors live. For the thread
// sanitizer as well.
#include <atomic>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <boxstream/near.hpp>
#include <boxstream/out_of_core.hpp>
#include <boxstream/world.hpp>

#include "batch/parallel/steps.hpp"
#include "batch/parallel/thrown.hpp"
#include "box_sets.hpp"
#include "executors.hpp"
#include "holding.hpp"
#include "many_sets.hpp"
#include "out_of_core/vector_reader.hpp"

namespace boxstream::tests {
namespace {

/// Fails when all its tasks have returned.
class FailingExecutor final : public Executor {
 public:
  unsigned concurrency() const override { return 4; }
  void parallel_for(std::size_t count, FunctionRef<void(std::size_t)> task) override {
    for (std::size_t i = 0; i < count; ++i) task(i);
    throw std::runtime_error("the scheduler is at its end");
  }
};

struct Executors {
  ThreadExecutor threads{3}, late{3, true};
  InlineExecutor in_order{4};
  ReversedExecutor reversed{4};
  ShuffledExecutor shuffled{4};
  ElsewhereExecutor elsewhere{4};
  FailingExecutor failing;

  std::vector<std::pair<const char*, Executor*>> all() {
    return {{"none", nullptr},       {"threads", &threads},   {"late", &late},           {"in order", &in_order},
            {"reversed", &reversed}, {"shuffled", &shuffled}, {"elsewhere", &elsewhere}, {"failing", &failing}};
  }
};

/// A sink that raises in that call.
template <class Raise>
auto raising_in(std::size_t call, const Raise& raise) {
  return [call, &raise, calls = std::size_t{0}](auto) mutable {
    if (++calls == call) raise();
    return true;
  };
}

/// Calls `expect(executor, call)` for all executors and for some calls of a sink.
template <class Expect>
void for_each_case(const Expect& expect) {
  Executors executors;
  for (const auto& [name, executor] : executors.all())
    for (const std::size_t call : {1, 2, 4}) {
      if (executor == &executors.failing && call != 1) continue;  // it may end the search before
      SCOPED_TRACE(std::string(name) + ", call " + std::to_string(call));
      expect(executor, call);
    }
}

template <class S>
class ThrownBySinks : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(ThrownBySinks, Scalars);

TYPED_TEST(ThrownBySinks, OfOneSetAndOfTwo) {
  const auto a = box_set<TypeParam>("dense").make(17000, 3), b = box_set<TypeParam>("dense").make(17000, 4);
  for_each_case([&](Executor* executor, std::size_t call) {
    Detector detector(DetectorOptions{executor});
    expect_gone_once_caught([&](auto raise) { detector.stream_pairs(a, raising_in(call, raise)); });
    expect_gone_once_caught([&](auto raise) { detector.stream_pairs(a, b, raising_in(call, raise)); });
  });
}

TYPED_TEST(ThrownBySinks, OfManySets) {
  std::vector<std::size_t> sizes(400, 60);
  sizes.insert(sizes.begin() + 200, 17000);
  const auto sets = make_many<TypeParam>(sizes, 5);
  for_each_case([&](Executor* executor, std::size_t call) {
    Detector detector(DetectorOptions{executor});
    expect_gone_once_caught(
        [&](auto raise) { detector.stream_pairs(sets.boxes, sets.offsets, raising_in(call, raise)); });
  });
}

TYPED_TEST(ThrownBySinks, OfNearPairs) {
  std::vector<BasicBall<TypeParam>> balls;
  for (const auto& box : box_set<TypeParam>("dense").make(17000, 6))
    balls.push_back({{box.min[0], box.min[1], box.min[2]}, 0});
  for_each_case([&](Executor* executor, std::size_t call) {
    Detector detector(DetectorOptions{executor});
    expect_gone_once_caught(
        [&](auto raise) { stream_near_pairs(detector, balls, TypeParam{1}, raising_in(call, raise)); });
  });
}

TYPED_TEST(ThrownBySinks, OutOfCore) {
  out_of_core_test::VectorReader<TypeParam> reader(box_set<TypeParam>("dense").make(17000, 7));
  for_each_case([&](Executor* executor, std::size_t call) {
    OutOfCoreOptions options;
    options.executor = executor;
    expect_gone_once_caught([&](auto raise) { stream_pairs(reader, raising_in(call, raise), options); });
  });
}

TYPED_TEST(ThrownBySinks, OfAWorldsFilter) {
  const auto boxes = box_set<TypeParam>("dense").make(17000, 8);
  for_each_case([&](Executor* executor, std::size_t call) {
    if (dynamic_cast<FailingExecutor*>(executor) != nullptr) return;  // the update ends before a filter is asked
    WorldOptions options;
    options.executor = executor;
    BasicWorld<TypeParam> world(options);
    for (const auto& box : boxes) world.create(box);
    expect_gone_once_caught([&](auto raise) {
      world.update([&, calls = std::size_t{0}](ProxyId, ProxyId) mutable {
        if (++calls == call) raise();
        return true;
      });
    });
  });
}

/// Of what several parts throw the first one's comes out, and nothing of the others stays.
TEST(ThrownByParts, TheFirstOfSeveral) {
  Executors executors;
  for (const auto& [name, executor] : executors.all()) {
    if (executor == nullptr || executor == &executors.failing) continue;
    SCOPED_TRACE(name);
    std::atomic<int> held{0};
    struct Numbered {
      Numbered(std::size_t i, std::atomic<int>& count) : number(i), held(count) { ++held; }
      Numbered(const Numbered& other) : number(other.number), held(other.held) { ++held; }
      ~Numbered() { --held; }
      std::size_t number;
      std::atomic<int>& held;
    };
    std::size_t first = 0;
    try {
      detail::run_parts(*executor, 9, [&](std::size_t i) {
        if (i % 3 == 2) throw Numbered(i, held);
      });
    } catch (const Numbered& thrown) {
      first = thrown.number;
      EXPECT_EQ(held, 1);
    }
    EXPECT_EQ(first, 2u);
    EXPECT_EQ(held, 0);
  }
}

/// A job that ends early throws nothing; then what was kept ends with it.
TEST(ThrownByParts, WhatNobodyThrowsEndsWithTheJob) {
  const auto object = std::make_shared<int>(0);
  {
    detail::Thrown thrown;
    try {
      throw Holding(object);
    } catch (...) {
      thrown.keep(0);
    }
    EXPECT_GT(object.use_count(), 1);
  }
  EXPECT_EQ(object.use_count(), 1);
}

/// The beginning of a step may throw; what does the steps lives on until the node is done.
TEST(ThrownByParts, OfSteps) {
  std::vector<detail::Steps::Taken> taken(8);
  std::weak_ptr<int> thrown;
  const auto begin = [&](std::size_t step) -> std::size_t {
    if (step == 0) return 4;
    const auto object = std::make_shared<int>(0);
    thrown = object;
    throw Holding(object);
  };
  const auto work = [](std::size_t, std::size_t) {};
  detail::Steps steps(1, {taken.data(), taken.size()}, begin, work);
  steps.work(0);
  EXPECT_THROW(steps.rethrow(), Holding);
  EXPECT_TRUE(thrown.expired());
}

}  // namespace
}  // namespace boxstream::tests
