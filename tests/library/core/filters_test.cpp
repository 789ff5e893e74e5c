// SPDX-License-Identifier: MIT
#include <limits>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "box_sets.hpp"
#include "executors.hpp"
#include "random.hpp"
#include "same_pairs.hpp"

namespace boxstream::tests {
namespace {

/// Masks of all kinds: no bits, all bits, few bits, and pairs that only one side would accept.
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

/// `classes` kinds of boxes, each of which accepts few or many of the others; some kinds are rare.
Filters filters_of_classes(std::size_t n, std::size_t classes, std::uint64_t seed) {
  Random random(seed);
  Filters kinds(classes);
  const std::size_t bits = 1 + random.index(8);
  for (Filter& kind : kinds)
    kind = {1u << random.index(bits),
            random.index(3) == 0 ? 1u << random.index(bits) : static_cast<std::uint32_t>(random.index(1u << bits))};
  Filters filters(n);
  for (Filter& filter : filters) filter = kinds[random.index(1 + random.index(classes))];
  return filters;
}

/// `percent` of the boxes do not meet each other.
Filters static_filters(std::size_t n, std::size_t percent, std::uint64_t seed) {
  Random random(seed);
  Filters filters(n);
  for (Filter& filter : filters) filter = random.index(100) < percent ? Filter{1, 2} : Filter{2, 3};
  return filters;
}

/// `groups` groups that meet only themselves.
Filters group_filters(std::size_t n, std::size_t groups, std::uint64_t seed) {
  Random random(seed);
  Filters filters(n);
  for (Filter& filter : filters) filter.group = filter.mask = 1u << random.index(groups);
  return filters;
}

/// One box in `every` is made invalid, in one way or another.
template <class S>
void spoil(Boxes<S>& boxes, std::size_t every) {
  for (std::size_t i = every / 2; i < boxes.size(); i += every) {
    if (i % 2 == 0)
      boxes[i].max[i % 3] = std::numeric_limits<S>::quiet_NaN();
    else
      std::swap(boxes[i].min[i % 3] = std::numeric_limits<S>::infinity(), boxes[i].max[i % 3]);
  }
}

template <class S>
class FilteredSearch : public testing::Test {
 protected:
  void expect_filtered(const Boxes<S>& boxes, const Filters& filters, const char* scene) {
    const Stats stats = detector_.find_pairs(boxes, found_, filters);
    expect_same_pairs(found_, brute_force(boxes, filters), boxes, scene, boxes.size());
    EXPECT_EQ(stats.pairs, found_.size());
    EXPECT_EQ(stats.boxes, boxes.size());
    EXPECT_EQ(stats.invalid, count_invalid(boxes)) << scene;
  }
  void expect_filtered(const Boxes<S>& a, const Boxes<S>& b, const Filters& fa, const Filters& fb, const char* scene) {
    const Stats stats = detector_.find_pairs(a, b, found_, fa, fb);
    expect_same_pairs(found_, brute_force(a, b, fa, fb), a, b, scene, a.size());
    EXPECT_EQ(stats.pairs, found_.size());
    EXPECT_EQ(stats.boxes, a.size() + b.size());
    EXPECT_EQ(stats.invalid, count_invalid(a) + count_invalid(b)) << scene;
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
  this->expect_filtered(boxes, Filters(300, Filter{0, 0}), "none");
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

TYPED_TEST(FilteredSearch, AnyNumberOfClasses) {
  for (const std::size_t classes : {1, 2, 3, 5, 10, 31, 63, 64, 65, 100})
    for (const std::size_t n : {40, 65, 130, 700, 2000})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        auto a = box_set<TypeParam>("dense").make(n, seed), b = box_set<TypeParam>("dense").make(n - 20, seed + 1);
        if (seed == 2) {
          spoil(a, 10);
          spoil(b, 7);
        }
        const Filters fa = filters_of_classes(a.size(), classes, seed), fb = filters_of_classes(b.size(), 3, seed + 1);
        const std::string scene = std::to_string(classes) + " classes";
        this->expect_filtered(a, fa, scene.c_str());
        this->expect_filtered(a, b, fa, fb, scene.c_str());
        this->expect_filtered(b, a, {}, fa, scene.c_str());
        this->expect_filtered(a, b, fa, {}, scene.c_str());
      }
}

TYPED_TEST(FilteredSearch, StaticBoxesAndGroups) {
  for (const char* name : {"dense", "rods_mixed", "below_float"})
    for (const std::size_t n : {300, 1000, 2500})
      for (const bool spoilt : {false, true}) {
        auto boxes = box_set<TypeParam>(name).make(n, n);
        if (spoilt) spoil(boxes, 9);
        for (const std::size_t percent : {1, 50, 90, 99, 100})
          this->expect_filtered(boxes, static_filters(boxes.size(), percent, n), "static");
        for (const std::size_t groups : {2, 10, 32})
          this->expect_filtered(boxes, group_filters(boxes.size(), groups, n), "groups");
      }
}

/// One class that all others meet, and that does not meet itself: whichever comes first, each of the others meets it.
TYPED_TEST(FilteredSearch, GroupsInOneWorld) {
  const auto boxes = box_set<TypeParam>("dense").make(2000, 8);
  for (const std::size_t percent : {5, 50, 95}) {
    Random random(percent);
    Filters filters(boxes.size());
    for (Filter& filter : filters) {
      const std::uint32_t group = 2u << random.index(10);
      filter = random.index(100) < percent ? Filter{1, 0xfffffffeu} : Filter{group, group | 1};
    }
    this->expect_filtered(boxes, filters, "groups in one world");
  }
}

/// Filters that differ in bits that no other filter has make no classes of their own.
TYPED_TEST(FilteredSearch, ManyFiltersThatAcceptTheSame) {
  const auto boxes = box_set<TypeParam>("dense").make(3000, 9);
  Random random(9);
  Filters filters(boxes.size());
  for (Filter& filter : filters) {
    const auto unused = static_cast<std::uint32_t>(random.index(32)) << 8;
    filter = random.index(10) != 0 ? Filter{1, 2 | unused} : Filter{2, 3 | unused};
  }
  this->expect_filtered(boxes, filters, "static boxes, 64 filters");
}

/// What cannot meet is not compared. Of so few boxes that none of the searches cuts them up.
TYPED_TEST(FilteredSearch, SavesComparisons) {
  for (const char* name : {"dense", "sparse"}) {
    const std::size_t n = 2000;
    const auto boxes = box_set<TypeParam>(name).make(n, 10);
    const auto tests = [&](const Filters& filters) {
      return this->detector_.find_pairs(boxes, this->found_, filters).tests;
    };
    const std::uint64_t all = tests({});
    EXPECT_EQ(tests(static_filters(n, 100, 1)), 0u) << name;
    EXPECT_LE(tests(group_filters(n, 10, 1)), all / 3) << name;
    EXPECT_LE(tests(static_filters(n, 90, 1)), all / 2) << name;
    EXPECT_LE(tests(static_filters(n, 99, 1)), all / 8) << name;
  }
}

/// Filters that refuse no pair, or few at random, leave the search as it is.
TYPED_TEST(FilteredSearch, OrdinaryFiltersChangeNothing) {
  const std::size_t n = 5000;
  const auto boxes = box_set<TypeParam>("dense").make(n, 14);
  Pairs plain;
  const Stats stats = this->detector_.find_pairs(boxes, plain);
  Filters one_class(n), classes_that_all_meet(n);
  for (std::size_t i = 0; i < n; ++i) classes_that_all_meet[i] = {1u << i % 8, 255};
  for (const Filters& filters : {one_class, classes_that_all_meet}) {
    const Stats filtered = this->detector_.find_pairs(boxes, this->found_, filters);
    EXPECT_EQ(this->found_, plain);
    EXPECT_EQ(filtered.tests, stats.tests);
    EXPECT_EQ(filtered.records, stats.records);
  }
  const Stats half = this->detector_.find_pairs(boxes, this->found_, static_filters(n, 40, 1));
  EXPECT_EQ(half.tests, stats.tests);
}

TYPED_TEST(FilteredSearch, SameOrderForAnyNumberOfThreads) {
  const auto boxes = box_set<TypeParam>("dense").make(40000, 11), others = box_set<TypeParam>("dense").make(50000, 12);
  for (const Filters& filters : {static_filters(boxes.size(), 50, 1), static_filters(boxes.size(), 92, 1),
                                 group_filters(boxes.size(), 2, 1), group_filters(boxes.size(), 10, 1)}) {
    const Filters of_others = static_filters(others.size(), 50, 2);
    Pairs alone, alone_between, found;
    const Stats stats = this->detector_.find_pairs(boxes, alone, filters);
    this->detector_.find_pairs(boxes, others, alone_between, filters, of_others);
    ASSERT_FALSE(alone.empty());
    for (const unsigned threads : {2u, 3u, 16u}) {
      InlineExecutor executor(threads);
      Detector team(DetectorOptions{&executor});
      const Stats of_team = team.find_pairs(boxes, found, filters);
      EXPECT_EQ(found, alone);
      EXPECT_EQ(of_team.tests, stats.tests);
      EXPECT_EQ(of_team.pairs, stats.pairs);
      team.find_pairs(boxes, others, found, filters, of_others);
      EXPECT_EQ(found, alone_between);
    }
  }
}

/// Between two joins as well as in one of them.
TYPED_TEST(FilteredSearch, StopsAnywhere) {
  InlineExecutor several(4);
  for (Executor* executor : {static_cast<Executor*>(nullptr), static_cast<Executor*>(&several)}) {
    Detector detector(DetectorOptions{executor});
    const auto boxes = box_set<TypeParam>("dense").make(30000, 13);
    for (const Filters& filters : {static_filters(boxes.size(), 92, 1), group_filters(boxes.size(), 10, 1)}) {
      Pairs whole;
      detector.find_pairs(boxes, whole, filters);
      for (std::size_t part = 0; part < 20; ++part) {
        const std::size_t enough = whole.size() * part / 20;
        Pairs streamed;
        const Stats stats = detector.stream_pairs(
            boxes,
            [&](Span<const Pair> pairs) {
              EXPECT_LE(streamed.size(), enough) << "called again after it returned false";
              streamed.insert(streamed.end(), pairs.begin(), pairs.end());
              return streamed.size() <= enough;
            },
            filters);
        EXPECT_EQ(stats.pairs, streamed.size());
        EXPECT_GT(streamed.size(), enough);
        ASSERT_TRUE(std::equal(streamed.begin(), streamed.end(), whole.begin()));
      }
    }
  }
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
