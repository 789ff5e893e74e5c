// SPDX-License-Identifier: MIT
#include <stdexcept>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "random.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

/// Masks of all kinds: nobody, everybody, few bits, and pairs that only one side would accept.
Filters random_filters(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  const auto bits = [&]() -> std::uint32_t {
    switch (random.index(5)) {
      case 0:
        return 0;
      case 1:
        return 0xffffffffu;
      case 2:
        return 1u << random.index(32);
      case 3:
        return 0x80000001u;
      default:
        return static_cast<std::uint32_t>(random.index(16));
    }
  };
  Filters filters(n);
  for (Filter& filter : filters) filter = {bits(), bits()};
  return filters;
}

template <class S>
class FilteredSearch : public testing::Test {
 protected:
  void expect_filtered(const Boxes<S>& boxes, const Filters& filters, const char* scene) {
    const Stats stats = detector_.find_pairs(boxes, found_, filters);
    expect_same_pairs(found_, brute_force(boxes, filters), boxes, scene, boxes.size());
    EXPECT_EQ(stats.pairs, found_.size());
  }
  void expect_filtered(const Boxes<S>& a, const Boxes<S>& b, const Filters& fa, const Filters& fb, const char* scene) {
    const Stats stats = detector_.find_pairs(a, b, found_, fa, fb);
    expect_same_pairs(found_, brute_force(a, b, fa, fb), a, b, scene, a.size());
    EXPECT_EQ(stats.pairs, found_.size());
  }

  Detector detector_;
  Pairs found_;
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(FilteredSearch, Scalars);

TYPED_TEST(FilteredSearch, EqualsFilteredTruth) {
  for (const char* name : {"dense", "all_overlapping", "ties", "rods_mixed", "below_float"})
    for (const std::size_t n : {2, 17, 65, 300, 700}) {
      const auto a = box_set<TypeParam>(name).make(n, n), b = box_set<TypeParam>(name).make(n / 2 + 1, n + 1);
      this->expect_filtered(a, random_filters(a.size(), n), name);
      this->expect_filtered(a, b, random_filters(a.size(), n), random_filters(b.size(), n + 1), name);
    }
}

TYPED_TEST(FilteredSearch, NobodyAndEverybody) {
  const auto boxes = box_set<TypeParam>("all_overlapping").make(300, 1);
  this->expect_filtered(boxes, Filters(300, Filter{0, 0}), "nobody");
  EXPECT_TRUE(this->found_.empty());
  this->expect_filtered(boxes, Filters(300, Filter{0xffffffffu, 0}), "masks of nothing");
  EXPECT_TRUE(this->found_.empty());
  this->expect_filtered(boxes, Filters(300, Filter{0, 0xffffffffu}), "groups of nothing");
  EXPECT_TRUE(this->found_.empty());
  this->expect_filtered(boxes, Filters(300), "defaults");
  EXPECT_EQ(this->found_.size(), 300u * 299 / 2);
}

/// One side accepts, the other does not, whichever of them comes first.
TYPED_TEST(FilteredSearch, BothSidesMustAccept) {
  const auto boxes = box_set<TypeParam>("all_overlapping").make(300, 2);
  Filters filters(300);
  for (std::size_t i = 0; i < filters.size(); ++i) filters[i] = i % 2 == 0 ? Filter{1, 2} : Filter{2, 2};
  this->expect_filtered(boxes, filters, "even ones refuse each other and are refused by odd ones");
  EXPECT_EQ(this->found_.size(), 150u * 149 / 2);
  const Filters even(300, Filter{1, 2}), odd(300, Filter{2, 2}), willing(300, Filter{2, 1});
  this->expect_filtered(boxes, boxes, even, odd, "only the first set accepts");
  EXPECT_TRUE(this->found_.empty());
  this->expect_filtered(boxes, boxes, odd, even, "only the second set accepts");
  EXPECT_TRUE(this->found_.empty());
  this->expect_filtered(boxes, boxes, even, willing, "both accept");
  EXPECT_EQ(this->found_.size(), 300u * 300);
}

/// A set without filters is one of default filters, also when the other set has some.
TYPED_TEST(FilteredSearch, FiltersForOneOfTwoSets) {
  const auto a = box_set<TypeParam>("dense").make(200, 3), b = box_set<TypeParam>("dense").make(200, 4);
  this->expect_filtered(a, b, random_filters(200, 3), {}, "first set only");
  this->expect_filtered(a, b, {}, random_filters(200, 4), "second set only");
}

TYPED_TEST(FilteredSearch, StreamsTheSame) {
  const auto boxes = box_set<TypeParam>("dense").make(2000, 5);
  const Filters filters = random_filters(2000, 5);
  Pairs streamed;
  this->detector_.stream_pairs(
      boxes,
      [&](Span<const Pair> pairs) {
        EXPECT_FALSE(pairs.empty());
        streamed.insert(streamed.end(), pairs.begin(), pairs.end());
        return true;
      },
      filters);
  this->expect_filtered(boxes, filters, "dense");
  EXPECT_EQ(streamed, this->found_);
}

TYPED_TEST(FilteredSearch, WrongCountIsAnErrorAndLeavesNothing) {
  const auto a = box_set<TypeParam>("dense").make(40, 6), b = box_set<TypeParam>("dense").make(30, 7);
  const auto sink = [](Span<const Pair>) { return true; };
  for (const std::size_t wrong : {1, 39, 41}) {
    const Filters filters(wrong), right(30);
    Pairs& out = this->found_;
    out = {{1, 2}};
    EXPECT_THROW(this->detector_.find_pairs(a, out, filters), std::invalid_argument);
    EXPECT_TRUE(out.empty());
    out = {{1, 2}};
    EXPECT_THROW(this->detector_.find_pairs(a, b, out, filters, right), std::invalid_argument);
    EXPECT_TRUE(out.empty());
    EXPECT_THROW(this->detector_.find_pairs(b, a, out, right, filters), std::invalid_argument);
    EXPECT_THROW(this->detector_.find_pairs(a, b, out, filters), std::invalid_argument);
    EXPECT_THROW(this->detector_.find_pairs(b, a, out, {}, filters), std::invalid_argument);
    EXPECT_THROW(this->detector_.stream_pairs(a, sink, filters), std::invalid_argument);
    EXPECT_THROW(this->detector_.stream_pairs(a, b, sink, filters, right), std::invalid_argument);
    EXPECT_THROW(this->detector_.find_pairs(Boxes<TypeParam>{}, out, filters), std::invalid_argument);
  }
  this->expect_filtered(a, random_filters(40, 6), "after the errors");
}

}  // namespace
}  // namespace boxstream::tests
