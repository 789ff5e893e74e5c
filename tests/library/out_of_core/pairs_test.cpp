// SPDX-License-Identifier: MIT
// Pairs of sets that do not fit in the memory given: the truth, in an order that is always the same.
#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/box_sets.hpp"
#include "core/executors.hpp"
#include "core/fast_oracle.hpp"
#include "core/random.hpp"
#include "core/same_pairs.hpp"
#include "vector_reader.hpp"

namespace boxstream::out_of_core_test {
namespace {

using tests::Pairs;

constexpr std::uint64_t least_memory = 64 << 10;

template <class S>
struct Found {
  Pairs pairs;
  OutOfCoreStats stats;
};

template <class S>
Found<S> find(BasicBoxReader<S>& reader, std::uint64_t memory, Executor* executor = nullptr) {
  Found<S> found;
  const auto sink = [&](Span<const WidePair> pairs) {
    EXPECT_FALSE(pairs.empty());
    for (const WidePair pair : pairs) {
      EXPECT_LT(pair.a, pair.b);
      found.pairs.push_back({static_cast<std::uint32_t>(pair.a), static_cast<std::uint32_t>(pair.b)});
    }
    return true;
  };
  found.stats = stream_pairs(reader, sink, {memory, {}, executor});
  return found;
}

template <class S>
class OutOfCore : public testing::Test {};
using Scalars = testing::Types<float, double>;
TEST(WidePairs, AreOrderedByTheFirstThenTheSecond) {
  std::vector<WidePair> pairs = {{2, 3}, {1, std::uint64_t{1} << 40}, {1, 5}};
  std::sort(pairs.begin(), pairs.end());
  EXPECT_EQ(pairs, (std::vector<WidePair>{{1, 5}, {1, std::uint64_t{1} << 40}, {2, 3}}));
}

TYPED_TEST_SUITE(OutOfCore, Scalars);

TYPED_TEST(OutOfCore, EqualsTruthForSetsOfEveryKind) {
  std::uint64_t stored = 0;
  for (const auto& set : tests::box_sets_to_repeat<TypeParam>())
    for (const std::uint64_t seed : {1, 2}) {
      VectorReader<TypeParam> reader(set.make(std::min<std::size_t>(4000, set.largest), seed));
      const auto found = find<TypeParam>(reader, least_memory * seed);
      const Pairs truth = tests::brute_force(reader.boxes());
      ASSERT_TRUE(tests::expect_same_pairs<TypeParam>(found.pairs, truth, reader.boxes(), set.name, seed));
      EXPECT_EQ(found.stats.boxes, reader.boxes().size()) << set.name;
      EXPECT_EQ(found.stats.pairs, truth.size()) << set.name;
      EXPECT_EQ(found.stats.invalid, tests::count_invalid(reader.boxes())) << set.name;
      stored += found.stats.copies;
    }
  EXPECT_GT(stored, 4000u);
}

/// With whole coordinates, so that many boxes touch, are flat, or are exactly as far apart as the tolerance.
TYPED_TEST(OutOfCore, OpenBoxesAndATolerance) {
  tests::Random random(5);
  Boxes<TypeParam> boxes(4000);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = static_cast<TypeParam>(random.integer(0, 60));
      box.max[d] = box.min[d] + static_cast<TypeParam>(random.integer(0, 3));
    }
  for (const bool touching : {true, false})
    for (const int tolerance : {0, 2}) {
      Pairs truth;
      for (std::uint32_t i = 0; i < boxes.size(); ++i)
        for (std::uint32_t j = i + 1; j < boxes.size(); ++j) {
          TypeParam gap = -1000;
          for (int d = 0; d < 3; ++d)
            gap = std::max({gap, boxes[i].min[d] - boxes[j].max[d], boxes[j].min[d] - boxes[i].max[d]});
          if (touching ? gap <= TypeParam(tolerance) : gap < TypeParam(tolerance)) truth.push_back({i, j});
        }
      OutOfCoreOptions options;
      options.memory = least_memory;
      options.touching = touching;
      options.tolerance = tolerance;
      VectorReader<TypeParam> reader(boxes);
      Pairs found;
      const auto take = [&](Span<const WidePair> pairs) {
        for (const WidePair pair : pairs)
          found.push_back({static_cast<std::uint32_t>(pair.a), static_cast<std::uint32_t>(pair.b)});
        return true;
      };
      EXPECT_GT(stream_pairs(reader, take, options).copies, 4000u);
      ASSERT_TRUE(tests::expect_same_pairs<TypeParam>(found, truth, boxes, "rules", 5)) << touching << tolerance;
      options.tolerance = -1;
      EXPECT_THROW(stream_pairs(reader, take, options), std::invalid_argument);
    }
}

TYPED_TEST(OutOfCore, DividesRegionsThatDoNotFitAgain) {
  VectorReader<TypeParam> reader(tests::box_set<TypeParam>("sparse").make(20000, 3));
  const auto found = find<TypeParam>(reader, least_memory);
  EXPECT_GT(found.stats.copies, 2 * found.stats.boxes);  // each was written more than once
  ASSERT_TRUE(
      tests::expect_same_pairs<TypeParam>(found.pairs, tests::sweep(reader.boxes()), reader.boxes(), "sparse", 3));
}

TYPED_TEST(OutOfCore, SearchesBlocksOfWhatCannotBeSeparated) {
  Boxes<TypeParam> boxes(1500, {{0, 0, 0}, {1, 1, 1}});
  for (std::size_t i = 0; i < boxes.size(); i += 3) boxes[i].min[0] = boxes[i].max[0] = 2;
  VectorReader<TypeParam> reader(boxes);
  const auto found = find<TypeParam>(reader, least_memory);
  EXPECT_GE(found.stats.searches, 10u);
  ASSERT_TRUE(tests::expect_same_pairs<TypeParam>(found.pairs, tests::brute_force(boxes), boxes, "two stacks", 0));
}

TYPED_TEST(OutOfCore, OrderIsAFunctionOfBoxesAndMemory) {
  const auto boxes = tests::box_set<TypeParam>("dense").make(6000, 5);
  VectorReader<TypeParam> one(boxes), other(boxes, 1);
  tests::InlineExecutor executor(3);
  const Pairs order = find<TypeParam>(one, 4 * least_memory).pairs;
  EXPECT_EQ(find<TypeParam>(one, 4 * least_memory).pairs, order);
  EXPECT_EQ(find<TypeParam>(other, 4 * least_memory, &executor).pairs, order);
}

/// Where threads search, too, of which the pairs that they hold back take memory from the boxes.
TYPED_TEST(OutOfCore, OrderIsTheSameWithThreads) {
  const std::size_t between = sizeof(TypeParam) == 4 ? 130000 : 120000;  // fits without what is held back alone
  const auto boxes = tests::box_set<TypeParam>("sparse").make(between, 7);
  VectorReader<TypeParam> one(boxes), other(boxes);
  tests::InlineExecutor executor(3);
  constexpr std::uint64_t memory = 64 << 20;
  const auto alone = find<TypeParam>(one, memory), shared = find<TypeParam>(other, memory, &executor);
  EXPECT_EQ(shared.pairs, alone.pairs);
  EXPECT_EQ(shared.stats.searches, alone.stats.searches);
  EXPECT_EQ(shared.stats.bytes_written, alone.stats.bytes_written);
}

TYPED_TEST(OutOfCore, ReadsOnceAndWritesNothingWhereBoxesFit) {
  VectorReader<TypeParam> reader(tests::box_set<TypeParam>("dense").make(6000, 5));
  const OutOfCoreStats stats = find<TypeParam>(reader, 1 << 24).stats;
  EXPECT_EQ(stats.boxes_read, 6000u);
  EXPECT_EQ(stats.searches, 1u);
  EXPECT_EQ(stats.bytes_written + stats.bytes_read + stats.file_bytes, 0u);
}

/// The cost that the header states: two passes over the input, one more over a few copies.
TYPED_TEST(OutOfCore, ReadsTwiceAndWritesOnceWhereRegionsFit) {
  const std::size_t n = 200000;
  VectorReader<TypeParam> reader(tests::box_set<TypeParam>("sparse").make(n, 1));
  std::uint64_t pairs = 0;
  const OutOfCoreStats stats = stream_pairs(reader,
                                            [&](Span<const WidePair> batch) {
                                              pairs += batch.size();
                                              return true;
                                            },
                                            {std::uint64_t{4} << 20});
  EXPECT_EQ(stats.boxes_read, 2 * n);
  EXPECT_GT(stats.copies, n);
  EXPECT_LT(stats.copies, n * 3 / 2);
  EXPECT_EQ(stats.bytes_written, stats.bytes_read);
  EXPECT_LT(stats.file_bytes, stats.bytes_written * 11 / 10);
  Pairs truth;
  Detector().find_pairs(reader.boxes(), truth);
  EXPECT_EQ(pairs, truth.size());
}

TYPED_TEST(OutOfCore, NoBoxesAndOneBox) {
  for (const std::size_t n : {0, 1, 2}) {
    VectorReader<TypeParam> reader(Boxes<TypeParam>(n, {{0, 0, 0}, {1, 1, 1}}));
    const auto found = find<TypeParam>(reader, least_memory);
    EXPECT_EQ(found.stats.boxes, n);
    EXPECT_EQ(found.pairs.size(), n == 2 ? 1u : 0u);
  }
}

}  // namespace
}  // namespace boxstream::out_of_core_test
