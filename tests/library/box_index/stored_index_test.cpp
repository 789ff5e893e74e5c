// SPDX-License-Identifier: MIT
//
// Indices as bytes: loaded they answer as before, and damaged ones are refused.

#include <bit>
#include <cstdint>
#include <cstring>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "box_index/answers.hpp"
#include "box_index/stored_bytes.hpp"

namespace boxstream::tests {
namespace {

template <class S>
class StoredIndices : public testing::Test {
 protected:
  static StoredBytes saved(std::size_t hard_boxes) { return BasicBoxIndex<S>(boxes(hard_boxes)).save(); }
  static Boxes<S> boxes(std::size_t count) {
    Boxes<S> all;
    for (std::uint64_t i = 0; i < count; ++i) all.push_back(box_from<S>(i));
    return all;
  }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(StoredIndices, Scalars);

/// Why it is refused; nothing if it is not.
template <class S>
std::string refusal(const StoredBytes& bytes) {
  try {
    BasicBoxIndex<S>::load(bytes);
    return {};
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

TYPED_TEST(StoredIndices, AnswerAsBefore) {
  for (const std::size_t count : {0, 1, 2, 8, 9, 70, 600}) {
    SCOPED_TRACE(count);
    const auto boxes = this->boxes(count);
    const StoredBytes bytes = this->saved(count);
    const auto loaded = BasicBoxIndex<TypeParam>::load(bytes);
    Boxes<TypeParam> places;
    for (std::uint64_t i = 0; i < 30; ++i) places.push_back(box_from<TypeParam>(5000 + i));
    expect_answers(loaded, boxes, places);
    EXPECT_EQ(loaded.save(), bytes);
  }
}

/// What files have in them stays readable.
TYPED_TEST(StoredIndices, AreTheseBytes) {
  constexpr TypeParam nan = std::numeric_limits<TypeParam>::quiet_NaN();
  const Boxes<TypeParam> boxes = {{{nan, 0, 0}, {1, 1, 1}}, {{0, -1, 2}, {3, 4, 5}}};
  constexpr std::size_t size = sizeof(TypeParam);
  StoredBytes expected(40 + 6 * size + 8);
  std::memcpy(expected.data(), "boxindex", 8);
  set_number(expected, 8, 1, 4);
  set_number(expected, 12, size, 4);
  set_number(expected, 16, 2, 8);
  set_number(expected, 24, 1, 8);
  std::size_t at = 40;
  for (const TypeParam x : {0, -1, 2, 3, 4, 5}) {
    if constexpr (size == 4)
      set_number(expected, at, std::bit_cast<std::uint32_t>(x), 4);
    else
      set_number(expected, at, std::bit_cast<std::uint64_t>(x), 8);
    at += size;
  }
  set_number(expected, at, 1, 4);
  set_number(expected, at + 4, 0, 4);
  sign(expected);
  EXPECT_EQ(BasicBoxIndex<TypeParam>(boxes).save(), expected);
}

TYPED_TEST(StoredIndices, EachFlippedByteAndEachTruncationIsRefused) {
  const StoredBytes bytes = this->saved(20);
  ASSERT_EQ(refusal<TypeParam>(bytes), "");
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (const unsigned flip : {0x01u, 0x80u, 0xffu}) {
      StoredBytes damaged = bytes;
      damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ flip);
      const std::string why = refusal<TypeParam>(damaged);
      EXPECT_EQ(why.substr(0, 11), "boxstream: ") << at;
      EXPECT_EQ(why.find('\n'), std::string::npos);
    }
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_NE(refusal<TypeParam>({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}), "") << size;
  StoredBytes longer = bytes;
  longer.push_back(0);
  EXPECT_NE(refusal<TypeParam>(longer), "");
}

/// StoredBytes with a right checksum, whatever else they say, are refused or make an index that answers.
TYPED_TEST(StoredIndices, SignedNonsenseIsRefusedOrAnswers) {
  const StoredBytes bytes = this->saved(20);
  std::mt19937 random(1);
  int accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    StoredBytes other = bytes;
    for (unsigned flips = random() % 3 + 1; flips != 0; --flips)
      other[random() % other.size()] = static_cast<std::uint8_t>(random());
    if (random() % 8 == 0) other.resize(40 + random() % (other.size() - 39));
    sign(other);
    if (!refusal<TypeParam>(other).empty()) continue;
    ++accepted;
    const auto index = BasicBoxIndex<TypeParam>::load(other);
    const TypeParam point[3] = {1, 2, 3};
    EXPECT_EQ(nearest(index, point, 20).size(), nearest(BasicBoxIndex<TypeParam>::load(bytes), point, 20).size());
    for (const std::size_t box : in_box(index, {{0, 0, 0}, {9, 9, 9}})) EXPECT_LT(box, index.size());
    on_ray(index, ray_from<TypeParam>(static_cast<std::uint64_t>(i)));
  }
  EXPECT_GT(accepted, 1000);
}

TYPED_TEST(StoredIndices, SayWhatIsWrong) {
  using Other = std::conditional_t<sizeof(TypeParam) == 4, double, float>;
  constexpr std::size_t size = sizeof(TypeParam);
  const auto changed = [&](std::size_t at, std::uint64_t x, std::size_t bytes_of_x) {
    StoredBytes bytes = BasicBoxIndex<TypeParam>(Boxes<TypeParam>(3, {{0, 0, 0}, {1, 1, 1}})).save();
    set_number(bytes, at, x, bytes_of_x);
    sign(bytes);
    return refusal<TypeParam>(bytes);
  };
  EXPECT_EQ(refusal<TypeParam>({}), "boxstream: these bytes are not of a BoxIndex");
  EXPECT_EQ(refusal<TypeParam>(StoredBytes(100, 'x')), "boxstream: these bytes are not of a BoxIndex");
  EXPECT_EQ(changed(8, 2, 4), "boxstream: an index of version 2; only 1 is read");
  EXPECT_EQ(refusal<Other>(this->saved(3)), "boxstream: an index whose coordinates have " + std::to_string(size) +
                                                " bytes, not " + std::to_string(sizeof(Other)));
  const std::string of_boxes = "boxstream: a damaged index, which has not the bytes of its boxes";
  EXPECT_EQ(changed(16, 4, 8), of_boxes);
  EXPECT_EQ(changed(24, 2, 8), of_boxes);
  EXPECT_EQ(changed(24, ~std::uint64_t{0}, 8), of_boxes);
  EXPECT_EQ(changed(16, ~std::uint64_t{0}, 8), of_boxes);
  const std::string each_once = "boxstream: a damaged index, which has not each box once";
  EXPECT_EQ(changed(40 + 18 * size, 3, 4), each_once);
  EXPECT_EQ(changed(40 + 18 * size, 1, 4), each_once);
  EXPECT_EQ(changed(40 + size - 1, 0x7f, 1), "boxstream: a damaged index, with a box that is invalid");
}

}  // namespace
}  // namespace boxstream::tests
