// SPDX-License-Identifier: MIT
// The public value types and their helpers.
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>
#include <boxstream/boxstream.hpp>

namespace boxstream::tests {
namespace {

template <class S>
class AabbValues : public testing::Test {
 protected:
  static constexpr S nan = std::numeric_limits<S>::quiet_NaN();
  static constexpr S inf = std::numeric_limits<S>::infinity();
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(AabbValues, Scalars);

TYPED_TEST(AabbValues, AreSixPlainNumbers) {
  using Box = BasicAabb<TypeParam>;
  EXPECT_EQ(sizeof(Box), 6 * sizeof(TypeParam));
  static_assert(std::is_trivially_copyable_v<Box> && std::is_aggregate_v<Box>);
}

TYPED_TEST(AabbValues, IsValidRejectsNanAndInvertedOnEachSide) {
  using Box = BasicAabb<TypeParam>;
  constexpr Box unit{{0, 0, 0}, {1, 1, 1}};
  static_assert(is_valid(unit));
  EXPECT_TRUE(is_valid(Box{{0, 0, 0}, {0, 0, 0}}));
  EXPECT_TRUE(is_valid(Box{{TypeParam(0), 0, 0}, {-TypeParam(0), 0, 0}})) << "-0 == +0";
  EXPECT_TRUE(is_valid(Box{{-this->inf, -this->inf, -this->inf}, {this->inf, this->inf, this->inf}}));
  EXPECT_TRUE(is_valid(Box{{this->inf, 0, 0}, {this->inf, 0, 0}}));
  for (int d = 0; d < 3; ++d) {
    Box box = unit;
    box.min[d] = this->nan;
    EXPECT_FALSE(is_valid(box));
    box = unit;
    box.max[d] = this->nan;
    EXPECT_FALSE(is_valid(box));
    box = unit;
    box.min[d] = std::nextafter(TypeParam(1), TypeParam(2));
    EXPECT_FALSE(is_valid(box));
    box.max[d] = box.min[d];
    EXPECT_TRUE(is_valid(box));
    box.min[d] = this->inf;
    box.max[d] = -this->inf;
    EXPECT_FALSE(is_valid(box));
  }
}

TYPED_TEST(AabbValues, OverlapsIsClosedOnEachSide) {
  using Box = BasicAabb<TypeParam>;
  constexpr Box unit{{0, 0, 0}, {1, 1, 1}};
  static_assert(overlaps(unit, unit));
  for (int d = 0; d < 3; ++d) {
    Box next = unit;
    next.min[d] = 1;
    next.max[d] = 2;
    EXPECT_TRUE(overlaps(unit, next));
    EXPECT_TRUE(overlaps(next, unit));
    next.min[d] = std::nextafter(TypeParam(1), TypeParam(2));
    EXPECT_FALSE(overlaps(unit, next));
    EXPECT_FALSE(overlaps(next, unit));
  }
}

TYPED_TEST(AabbValues, MergedContainsBothAndNoMore) {
  using Box = BasicAabb<TypeParam>;
  const Box a{{0, -5, 2}, {1, 5, 3}}, b{{-1, 0, 2}, {0, 9, this->inf}};
  const Box both{{-1, -5, 2}, {1, 9, this->inf}};
  EXPECT_EQ(merged(a, b), both);
  EXPECT_EQ(merged(b, a), both);
  EXPECT_EQ(merged(a, a), a);
}

TYPED_TEST(AabbValues, ExpandedGrowsAllSixSides) {
  using Box = BasicAabb<TypeParam>;
  const Box box{{0, -this->inf, 2}, {1, 5, 3}};
  EXPECT_EQ(expanded(box, TypeParam(0.5)), (Box{{-0.5, -this->inf, 1.5}, {1.5, 5.5, 3.5}}));
  EXPECT_EQ(expanded(box, TypeParam(0)), box);
  // What leaves the range is infinite; what only comes near its end is not.
  constexpr TypeParam most = std::numeric_limits<TypeParam>::max();
  EXPECT_EQ(expanded(Box{{-most, -most / 2, 0}, {most / 2, most, this->inf}}, most / 4),
            (Box{{-this->inf, -most / 4 * 3, -most / 4}, {most / 4 * 3, this->inf, this->inf}}));
  EXPECT_EQ(expanded(Box{{0, this->inf, -this->inf}, {1, this->inf, -this->inf}}, this->inf),
            (Box{{-this->inf, -this->inf, -this->inf}, {this->inf, this->inf, this->inf}}));
}

TYPED_TEST(AabbValues, EqualityIsByValueOnEachSide) {
  using Box = BasicAabb<TypeParam>;
  const Box box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(box == box);
  EXPECT_TRUE(box == (Box{{-TypeParam(0), 0, 0}, {1, 1, 1}}));
  for (int d = 0; d < 3; ++d) {
    Box other = box;
    other.min[d] = -1;
    EXPECT_TRUE(box != other);
    EXPECT_FALSE(box == other);
    other = box;
    other.max[d] = this->nan;
    EXPECT_FALSE(other == other);
  }
}

TEST(Pair, IsOrderedByFirstThenSecond) {
  static_assert(Pair{1, 9} < Pair{2, 0});
  static_assert(Pair{1, 1} < Pair{1, 2});
  static_assert(!(Pair{1, 2} < Pair{1, 2}));
  static_assert(!(Pair{2, 0} < Pair{1, 9}));
  static_assert(Pair{1, 2} == Pair{1, 2} && Pair{1, 2} != Pair{1, 3} && Pair{1, 2} != Pair{0, 2});
  static_assert(sizeof(Pair) == 8);
  constexpr std::uint32_t top = 0xffffffffu;
  EXPECT_TRUE((Pair{0x7fffffffu, 0} < Pair{0x80000000u, 0})) << "indices are unsigned";
  EXPECT_TRUE((Pair{0, 1} < Pair{0, top}));
}

TEST(Filter, AcceptsNeedsBothDirections) {
  static_assert(accepts(Filter{}, Filter{}), "at compile time too");
  EXPECT_TRUE(accepts(Filter{}, Filter{}));
  EXPECT_TRUE(accepts(Filter{1, 2}, Filter{2, 1}));
  EXPECT_FALSE(accepts(Filter{1, 2}, Filter{2, 2}));
  EXPECT_FALSE(accepts(Filter{2, 2}, Filter{1, 2}));
  EXPECT_FALSE(accepts(Filter{1, 0}, Filter{}));
  EXPECT_FALSE(accepts(Filter{0, ~0u}, Filter{}));
  EXPECT_TRUE(accepts(Filter{0x80000000u, 0x80000000u}, Filter{0x80000000u, 0x80000000u}));
}

TEST(Span, ViewsContainersArraysAndNothing) {
  std::vector<int> vector{1, 2, 3, 4};
  const std::array<int, 2> array{5, 6};
  int raw[3] = {7, 8, 9};

  const Span<int> all = vector;
  EXPECT_EQ(all.data(), vector.data());
  EXPECT_EQ(all.size(), 4u);
  EXPECT_FALSE(all.empty());
  all[2] = 30;
  EXPECT_EQ(vector[2], 30);

  const Span<const int> middle = all.subspan(1, 2);
  EXPECT_EQ(std::vector<int>(middle.begin(), middle.end()), (std::vector<int>{2, 30}));
  EXPECT_EQ(Span<const int>(array)[1], 6);
  EXPECT_EQ(Span<const int>(raw).size(), 3u);
  EXPECT_EQ(Span<const int>(vector.data(), 1).size(), 1u);
  EXPECT_EQ(all.subspan(4, 0).size(), 0u);
  EXPECT_TRUE(Span<int>().empty());
  EXPECT_TRUE(BoxSpan().empty());
  EXPECT_EQ(Span<int>().data(), nullptr);
  static_assert(!std::is_convertible_v<Span<const int>, Span<int>>, "a view does not lose const");
  static_assert(!std::is_convertible_v<std::vector<float>, Span<const int>>);
}

int twice(int x) {
  return 2 * x;
}

TEST(FunctionRef, CallsLambdasFunctionPointersAndConstCallables) {
  int calls = 0;
  auto counting = [&calls](int x) {
    calls += x;
    return calls;
  };
  const FunctionRef<int(int)> counts = counting;
  EXPECT_EQ(counts(3), 3);
  EXPECT_EQ(counts(4), 7);
  const auto constant = [](int x) { return x + 1; };
  EXPECT_EQ(FunctionRef<int(int)>(constant)(1), 2);
  int (*pointer)(int) = twice;
  EXPECT_EQ(FunctionRef<int(int)>(pointer)(21), 42);
  const FunctionRef<int(int)> function = twice;
  EXPECT_EQ(function(4), 8);
}

TEST(FunctionRef, RefersAndDoesNotCopy) {
  struct Counter {
    int calls = 0;
    void operator()() { ++calls; }
    Counter() = default;
    Counter(const Counter&) = delete;
  } counter;
  const FunctionRef<void()> first = counter, second = first;
  first();
  second();
  EXPECT_EQ(counter.calls, 2);
}

TEST(FunctionRef, ForwardsReferencesAndMoveOnlyArguments) {
  auto append = [](std::string& text, std::unique_ptr<int> value) -> std::string& {
    return text += std::to_string(*value);
  };
  const FunctionRef<std::string&(std::string&, std::unique_ptr<int>)> ref = append;
  std::string text = "n = ";
  EXPECT_EQ(&ref(text, std::make_unique<int>(7)), &text);
  EXPECT_EQ(text, "n = 7");
  static_assert(!std::is_constructible_v<FunctionRef<int(int)>, std::string>, "only callables convert");
}

TEST(PairValues, CompareByAThenByB) {
  constexpr Pair pair{1, 5}, later{1, 6}, last{2, 3};
  EXPECT_TRUE(pair == pair);
  EXPECT_FALSE(pair != pair);
  EXPECT_TRUE(pair != later);
  EXPECT_TRUE(pair < later && later < last && !(last < pair));
}

}  // namespace
}  // namespace boxstream::tests
