// SPDX-License-Identifier: MIT
// Executors that do not do what is asked: they leave tasks out, run some twice, or run numbers that there are not.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <vector>

#include <boxstream/near.hpp>
#include <boxstream/world.hpp>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "search_record.hpp"

namespace boxstream::tests {
namespace {

class CarelessExecutor final : public Executor {
 public:
  using Task = FunctionRef<void(std::size_t)>;
  using Run = std::function<void(std::size_t count, Task task)>;

  explicit CarelessExecutor(Run run) : run_(std::move(run)) {}
  unsigned concurrency() const override { return 4; }
  std::uint32_t start_nanoseconds() override { return 0; }
  void parallel_for(std::size_t count, Task task) override {
    if (careful_calls > 0) {
      --careful_calls;
      return run_all(count, task);
    }
    ++careless_calls;
    run_(count, task);
  }

  static void run_all(std::size_t count, Task task) {
    for (std::size_t i = 0; i < count; ++i) task(i);
  }

  std::size_t careful_calls = 0;  // before it begins
  std::size_t careless_calls = 0;

 private:
  Run run_;
};

struct Kind {
  const char* name;
  CarelessExecutor::Run run;
};

const std::vector<Kind>& kinds() {
  using Task = CarelessExecutor::Task;
  static const std::vector<Kind> all{
      {"none", [](std::size_t, Task) {}},
      {"the first alone", [](std::size_t count, Task task) { CarelessExecutor::run_all(count > 0 ? 1 : 0, task); }},
      {"all but the first",
       [](std::size_t count, Task task) {
         for (std::size_t i = 1; i < count; ++i) task(i);
       }},
      {"every second",
       [](std::size_t count, Task task) {
         for (std::size_t i = 0; i < count; i += 2) task(i);
       }},
      {"the last twice",
       [](std::size_t count, Task task) {
         CarelessExecutor::run_all(count, task);
         if (count > 0) task(count - 1);
       }},
      {"one too many", [](std::size_t count, Task task) { CarelessExecutor::run_all(count + 1, task); }},
  };
  return all;
}

template <class S>
class CarelessExecutors : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(CarelessExecutors, Scalars);

TYPED_TEST(CarelessExecutors, EndASearchWithAnErrorAndNoPairs) {
  for (const char* const name : {"sparse", "dense", "rods_mixed"}) {
    const auto a = box_set<TypeParam>(name).make(17000, 1), b = box_set<TypeParam>(name).make(12000, 2);
    Detector serial;
    const auto expected = search_all<TypeParam>(serial, a, b);
    for (const Kind& kind : kinds()) {
      SCOPED_TRACE(std::string(name) + ", " + kind.name);
      CarelessExecutor executor(kind.run);
      Detector detector(DetectorOptions{&executor});
      std::vector<Pair> pairs{{7, 7}};
      EXPECT_THROW(detector.find_pairs(Span<const BasicAabb<TypeParam>>(a), pairs), std::logic_error);
      EXPECT_TRUE(pairs.empty());
      EXPECT_THROW(detector.find_pairs(Span<const BasicAabb<TypeParam>>(a), Span<const BasicAabb<TypeParam>>(b), pairs),
                   std::logic_error);
      EXPECT_TRUE(pairs.empty());
      PairsOfSets of_sets;
      const std::vector<std::uint64_t> offsets{0, 5000, 11000, 17000};
      EXPECT_THROW(detector.find_pairs(Span<const BasicAabb<TypeParam>>(a), SetOffsets(offsets), of_sets),
                   std::logic_error);
      EXPECT_EQ(executor.careless_calls, 3u);  // the first of each search
      executor.careful_calls = SIZE_MAX;
      expect_same_search(search_all<TypeParam>(detector, a, b), expected);
    }
  }
}

bool are_same(Span<const ProxyPair> a, Span<const ProxyPair> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const ProxyPair& p, const ProxyPair& q) { return p.a == q.a && p.b == q.b; });
}

/// An update is right, or an error that leaves the World as it was: the next one is right then.
TYPED_TEST(CarelessExecutors, DoNoHarmToAWorld) {
  using Box = BasicAabb<TypeParam>;
  std::vector<std::vector<Box>> frames;
  for (unsigned frame = 0; frame < 12; ++frame) {  // all move, few move, all move a little
    frames.push_back(frame == 0 ? box_set<TypeParam>("sparse").make(40000, 1) : frames.back());
    for (std::size_t i = 0; i < frames.back().size(); i += frame % 3 == 1 ? 13 : 1)
      for (TypeParam* const x : {&frames.back()[i].min[frame % 2], &frames.back()[i].max[frame % 2]})
        *x += TypeParam(frame % 3 == 0 ? 0.001 : 0.5);
  }
  for (const Kind& kind : kinds()) {
    SCOPED_TRACE(kind.name);
    CarelessExecutor executor(kind.run);
    WorldOptions options;
    options.executor = &executor;
    BasicWorld<TypeParam> world(options), alone;
    std::vector<ProxyId> ids(frames[0].size()), same(ids.size());
    world.create(Span<const Box>(frames[0]), {}, Span<ProxyId>(ids));
    alone.create(Span<const Box>(frames[0]), {}, Span<ProxyId>(same));
    std::size_t errors = 0;
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
      const auto& boxes = frames[frame];
      world.move(Span<const ProxyId>(ids), Span<const Box>(boxes));
      alone.move(Span<const ProxyId>(ids), Span<const Box>(boxes));
      executor.careful_calls = frame / 3 * 2;  // so that it is in one phase of an update or another
      try {
        world.update();
      } catch (const std::logic_error&) {
        ++errors;
        executor.careful_calls = SIZE_MAX;
        world.update();
      }
      alone.update();
      ASSERT_EQ(world.pair_count(), alone.pair_count());
      ASSERT_TRUE(are_same(world.begun(), alone.begun()));
      ASSERT_TRUE(are_same(world.ended(), alone.ended()));
      world.validate();
    }
    EXPECT_GT(errors, 0u);
    EXPECT_EQ(executor.careless_calls, errors);
  }
}

}  // namespace
}  // namespace boxstream::tests
