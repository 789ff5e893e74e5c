// SPDX-License-Identifier: MIT
// More boxes than 32-bit indices can name.
#include <cstdint>
#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

#include "base/arena.hpp"
#include "base/even_parts.hpp"
#include "oracle.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class Limits : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Limits, Scalars);

/// No machine of ours holds that many: the sizes are refused before a box is read.
TYPED_TEST(Limits, MoreBoxesThanIndicesAreAnErrorAndNothingIsLost) {
  using Box = BasicAabb<TypeParam>;
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const Span<const Box> few(&box, 1);
  Detector detector;
  Pairs out;
  const auto sink = [](Span<const Pair>) { return true; };
  for (const std::uint64_t count : {std::uint64_t{UINT32_MAX}, std::uint64_t{1} << 32, std::uint64_t{1} << 40}) {
    if (count > SIZE_MAX) break;
    const Span<const Box> many(&box, static_cast<std::size_t>(count));
    out = {{1, 2}};
    EXPECT_THROW(detector.find_pairs(many, out), std::length_error);
    EXPECT_TRUE(out.empty());
    EXPECT_THROW(detector.find_pairs(many, few, out), std::length_error);
    EXPECT_THROW(detector.find_pairs(few, many, out), std::length_error);
    EXPECT_THROW(detector.stream_pairs(many, sink), std::length_error);
    EXPECT_THROW(detector.stream_pairs(few, many, sink), std::length_error);
  }
  const Boxes<TypeParam> two(2, box);
  EXPECT_EQ(detector.find_pairs(two, out).pairs, 1u);
}

/// Nor is scratch memory of the remainder that is left of a size which no number can hold.
TEST(Limits, ScratchMemoryOfMoreBytesThanANumberHoldsIsAnError) {
  detail::Arena arena;
  EXPECT_THROW(arena.allocate<Pair>(SIZE_MAX / sizeof(Pair) + 2), std::bad_alloc);
  EXPECT_THROW(arena.allocate<std::uint64_t>(SIZE_MAX / 8), std::bad_alloc);
  EXPECT_EQ(arena.capacity(), 0u);
}

/// Where sizes have 32 bits, too.
TEST(Limits, PartsOfAsManyBoxesAsThereCanBeAreEven) {
  constexpr std::size_t size = UINT32_MAX, parts = 512;
  EXPECT_EQ(detail::begin_of_part(size, 0, parts), 0u);
  EXPECT_EQ(detail::begin_of_part(size, 384, parts), 3221225471u);
  EXPECT_EQ(detail::begin_of_part(size, parts, parts), size);
}

}  // namespace
}  // namespace boxstream::tests
