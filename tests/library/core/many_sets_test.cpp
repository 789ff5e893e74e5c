// SPDX-License-Identifier: MIT
// Many sets in one call: the pairs of each against brute force, and in the order of searches of their own.
#include "many_sets.hpp"

#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "executors.hpp"
#include "same_pairs.hpp"
#include "sanitized.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Many : public testing::Test {
 protected:
  Pairs pairs_of(std::size_t set, const std::vector<std::uint64_t>& a, const std::vector<std::uint64_t>& b) const {
    Pairs local;
    for (std::uint64_t i = found_.offsets[set]; i < found_.offsets[set + 1]; ++i)
      local.push_back({found_.pairs[i].a - static_cast<std::uint32_t>(a[set]),
                       found_.pairs[i].b - static_cast<std::uint32_t>(b[set])});
    return local;
  }

  Detector detector_;
  PairsOfSets found_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Many, Scalars);

TYPED_TEST(Many, EachSetIsThatOfBruteForce) {
  for (std::uint64_t seed = 1; seed <= (sanitized ? 2u : 10u); ++seed) {
    const auto sets = make_many<TypeParam>(uneven_sizes(80, seed), seed);
    for (const bool filtered : {false, true}) {
      const Stats stats = this->detector_.find_pairs(
          sets.boxes, sets.offsets, this->found_, filtered ? Span<const Filter>(sets.filters) : Span<const Filter>());
      ASSERT_EQ(this->found_.offsets.size(), sets.offsets.size());
      for (std::size_t i = 0; i < sets.size(); ++i) {
        const auto boxes = sets.set(i);
        const auto truth = filtered ? brute_force(boxes, sets.filters_of(i)) : brute_force(boxes);
        ASSERT_TRUE(expect_same_pairs(this->pairs_of(i, sets.offsets, sets.offsets), truth, boxes,
                                      "set " + std::to_string(i), seed));
      }
      EXPECT_EQ(stats.boxes, sets.boxes.size());
      EXPECT_EQ(stats.invalid, count_invalid(sets.boxes));
      EXPECT_EQ(stats.pairs, this->found_.pairs.size());
    }
  }
}

TYPED_TEST(Many, TwoSetsEachAreThoseOfBruteForce) {
  for (std::uint64_t seed = 1; seed <= (sanitized ? 2u : 10u); ++seed) {
    const auto a = make_many<TypeParam>(uneven_sizes(50, seed), seed);
    const auto b = make_many<TypeParam>(uneven_sizes(50, seed + 100), seed);
    const Stats stats =
        this->detector_.find_pairs(a.boxes, a.offsets, b.boxes, b.offsets, this->found_, a.filters, b.filters);
    for (std::size_t i = 0; i < a.size(); ++i) {
      const auto one = a.set(i), other = b.set(i);
      ASSERT_TRUE(expect_same_pairs(this->pairs_of(i, a.offsets, b.offsets),
                                    brute_force(one, other, a.filters_of(i), b.filters_of(i)), one, other,
                                    "sets " + std::to_string(i), seed));
    }
    EXPECT_EQ(stats.boxes, a.boxes.size() + b.boxes.size());
    EXPECT_EQ(stats.invalid, count_invalid(a.boxes) + count_invalid(b.boxes));
    EXPECT_EQ(stats.pairs, this->found_.pairs.size());
  }
}

/// Sizes around those where another way of searching begins, and one set that is larger than all others together.
TYPED_TEST(Many, OrderIsThatOfSearchesOfTheirOwn) {
  const std::size_t large = sanitized ? 17000 : 60000;
  const std::vector<std::vector<std::size_t>> mixes = {
      std::vector<std::size_t>(3000, 10),
      std::vector<std::size_t>(61, 11),
      std::vector<std::size_t>(300, 100),
      uneven_sizes(900, 1),
      {0, 1, 2, 7, 8, 9, 15, 16, 17, 31, 33, 63, 64, 65, 100, 127, 128, 129, 159, 160, 161, 200, 384, 385, 1000, 0, 0},
      {5, 0, 20, large, 7, 100, 0, 30, 18000, 16384, 3},
      {large},
      {},
      {0}};
  InlineExecutor in_line(4);
  ReversedExecutor reversed(3);
  ShuffledExecutor shuffled(64);
  ElsewhereExecutor elsewhere(2);
  for (std::size_t mix = 0; mix < mixes.size(); ++mix) {
    const auto a = make_many<TypeParam>(mixes[mix], mix), b = make_many<TypeParam>(mixes[mix], mix + 100);
    for (const bool filtered : {false, true}) {
      const Filters none;
      const Filters &filters_a = filtered ? a.filters : none, &filters_b = filtered ? b.filters : none;
      const PairsOfSets one = search_each(a, filtered), two = search_each(a, b, filtered);
      for (Executor* executor : std::initializer_list<Executor*>{nullptr, &in_line, &reversed, &shuffled, &elsewhere}) {
        const std::string what = "mix " + std::to_string(mix) + (filtered ? ", filtered" : "");
        Detector detector(DetectorOptions{executor});
        detector.find_pairs(a.boxes, a.offsets, this->found_, filters_a);
        expect_same_sets(this->found_, one, what);
        detector.find_pairs(a.boxes, a.offsets, b.boxes, b.offsets, this->found_, filters_a, filters_b);
        expect_same_sets(this->found_, two, what + ", two");
        Pairs streamed;
        const auto append = [&](Span<const Pair> pairs) {
          streamed.insert(streamed.end(), pairs.begin(), pairs.end());
          return true;
        };
        EXPECT_EQ(detector.stream_pairs(a.boxes, a.offsets, append, filters_a).pairs, one.pairs.size());
        EXPECT_EQ(streamed, one.pairs) << what;
        streamed.clear();
        detector.stream_pairs(a.boxes, a.offsets, b.boxes, b.offsets, append, filters_a, filters_b);
        EXPECT_EQ(streamed, two.pairs) << what;
      }
    }
  }
}

/// Work is counted alike by any executor.
TYPED_TEST(Many, StatsAreThoseOfOneThread) {
  const auto sets = make_many<TypeParam>(uneven_sizes(900, 2), 2);
  InlineExecutor several(4);
  Detector parallel(DetectorOptions{&several});
  const Stats one = this->detector_.find_pairs(sets.boxes, sets.offsets, this->found_);
  const Stats many = parallel.find_pairs(sets.boxes, sets.offsets, this->found_);
  EXPECT_GT(several.calls(), 0u);
  for (const auto count :
       {&Stats::boxes, &Stats::invalid, &Stats::pairs, &Stats::nodes, &Stats::cells, &Stats::records, &Stats::tests})
    EXPECT_EQ(one.*count, many.*count);
}

/// Boxes that meet the whole world, and those that meet nothing.
TYPED_TEST(Many, InfiniteAndInvalidBoxesStayInTheirSet) {
  constexpr auto inf = std::numeric_limits<TypeParam>::infinity();
  constexpr auto nan = std::numeric_limits<TypeParam>::quiet_NaN();
  const BasicAabb<TypeParam> all{{-inf, -inf, -inf}, {inf, inf, inf}}, unit{{0, 0, 0}, {1, 1, 1}},
      none{{0, nan, 0}, {1, 1, 1}}, inverted{{2, 0, 0}, {1, 1, 1}};
  for (const std::size_t n : {1, 5, 9, 40, 90, 170}) {
    ManySets<TypeParam> sets;
    Random random(1);
    for (int set = 0; set < 30; ++set) {
      Boxes<TypeParam> boxes(n, unit);
      boxes.insert(boxes.begin() + static_cast<std::ptrdiff_t>(n / 2), {none, all, inverted});
      sets.add(boxes, random);
    }
    const Stats stats = this->detector_.find_pairs(sets.boxes, sets.offsets, this->found_);
    EXPECT_EQ(stats.invalid, 60u);
    EXPECT_EQ(stats.pairs, 30 * n * (n + 1) / 2);
    expect_same_sets(this->found_, search_each(sets, false), std::to_string(n));
  }
}

TYPED_TEST(Many, SinksStopAnywhere) {
  const auto sets = make_many<TypeParam>(uneven_sizes(1200, 3), 3);
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)}) {
    Detector detector(DetectorOptions{executor});
    detector.find_pairs(sets.boxes, sets.offsets, this->found_);
    const Pairs& whole = this->found_.pairs;
    for (std::size_t ninth = 0; ninth < 9; ++ninth) {
      const std::size_t enough = whole.size() * ninth / 9;
      std::size_t streamed = 0, after = 0;
      bool in_order = true;
      const Stats stats = detector.stream_pairs(sets.boxes, sets.offsets, [&](Span<const Pair> pairs) {
        after += streamed > enough ? 1 : 0;
        in_order =
            in_order && std::equal(pairs.begin(), pairs.end(), whole.begin() + static_cast<std::ptrdiff_t>(streamed));
        streamed += pairs.size();
        return streamed <= enough;
      });
      EXPECT_TRUE(in_order);
      EXPECT_EQ(after, 0u) << "called again after it returned false";
      EXPECT_GT(streamed, enough);
      EXPECT_EQ(stats.pairs, streamed);
      EXPECT_LE(stats.invalid, count_invalid(sets.boxes));
    }
  }
}

TYPED_TEST(Many, SinksMayThrow) {
  const auto sets = make_many<TypeParam>(uneven_sizes(1200, 4), 4);
  const PairsOfSets expected = search_each(sets, false);
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)})
    for (int last = 1; last < 40; last += 6) {
      Detector detector(DetectorOptions{executor});
      int calls = 0;
      const auto throw_at_last = [&](Span<const Pair>) -> bool {
        if (++calls == last) throw std::runtime_error("enough");
        return true;
      };
      EXPECT_THROW(detector.stream_pairs(sets.boxes, sets.offsets, throw_at_last), std::runtime_error);
      EXPECT_EQ(calls, last);
      detector.find_pairs(sets.boxes, sets.offsets, this->found_);
      expect_same_sets(this->found_, expected, "after call " + std::to_string(last));
    }
}

TYPED_TEST(Many, WrongOffsetsAreRefused) {
  const Boxes<TypeParam> boxes(4, {{0, 0, 0}, {1, 1, 1}});
  using Offsets = std::vector<std::uint64_t>;
  const Offsets right = {0, 2, 4};
  const auto never = [](Span<const Pair>) -> bool { throw std::logic_error("called"); };
  for (const Offsets& wrong : {Offsets{}, Offsets{0}, Offsets{0, 3}, Offsets{1, 4}, Offsets{0, 3, 2, 4},
                               Offsets{0, 2, 5}, Offsets{0, 5, 4}, Offsets{0, ~std::uint64_t{0}, 4}}) {
    this->found_ = {{{1, 2}}, {0, 1}};
    EXPECT_THROW(this->detector_.find_pairs(boxes, wrong, this->found_), std::invalid_argument);
    EXPECT_TRUE(this->found_.pairs.empty() && this->found_.offsets.empty());
    EXPECT_THROW(this->detector_.stream_pairs(boxes, wrong, never), std::invalid_argument);
    EXPECT_THROW(this->detector_.find_pairs(boxes, wrong, boxes, right, this->found_), std::invalid_argument);
    EXPECT_THROW(this->detector_.stream_pairs(boxes, right, boxes, wrong, never), std::invalid_argument);
  }
  EXPECT_THROW(this->detector_.find_pairs(boxes, right, boxes, Offsets{0, 4}, this->found_), std::invalid_argument);
  EXPECT_THROW(this->detector_.find_pairs(boxes, right, this->found_, Filters(3)), std::invalid_argument);
  EXPECT_EQ(this->detector_.find_pairs(boxes, right, this->found_).pairs, 2u);
  EXPECT_EQ(this->found_.offsets, (Offsets{0, 1, 2}));
}

TYPED_TEST(Many, NoSetsHaveNoPairs) {
  const Boxes<TypeParam> none;
  const std::vector<std::uint64_t> offsets = {0};
  EXPECT_EQ(this->detector_.find_pairs(none, offsets, this->found_).boxes, 0u);
  EXPECT_EQ(this->found_.offsets, offsets);
}

}  // namespace
}  // namespace boxstream::tests
