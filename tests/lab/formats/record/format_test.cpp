// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <random>

#include "formats/record/op.hpp"
#include "streams.hpp"

namespace boxstream::record_test {
namespace {

using namespace record;

/// The example of docs/bsrec.md.
TEST(Format, BytesAreAsDocumented) {
  Header header;
  header.bounds = {{-1, -1, -1}, {1, 1, 1}};
  header.about = "two";
  const std::vector<Op> ops{Create{0, 0, 1, -1, {{0, 0, 0}, {1, 1, 1}}}, Create{1, 8, 1, -1, {{0, 2, 0}, {1, 3, 1}}},
                            Move{1, {{0, 1, 0}, {1, 2, 1}}}, Batch{digest_of({{0, 1}})}, Destroy{0}};
  const Bytes expected{'B',  'S',  'R',  'E',  'C',  0x0d, 0x0a, 0x1a,                          // magic
                       0x01, 0x04,                                                              // version 1, float
                       0x00, 0x00, 0x80, 0xbf, 0x00, 0x00, 0x80, 0xbf, 0x00, 0x00, 0x80, 0xbf,  // bounds from -1 -1 -1
                       0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x80, 0x3f,  // to 1 1 1
                       0x03, 't',  'w',  'o',                                                   // about
                       0x01, 0x00, 0x02, 0x01,  // create 0: shape 0, group 1, mask -1
                       0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,  // from 0 0 0
                       0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x80, 0x3f,  // to 1 1 1
                       0x01, 0x10, 0x02, 0x01,  // create 1: shape 8, group 1, mask -1
                       0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x40, 0x00, 0x00, 0x00, 0x00,  // from 0 2 0
                       0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x40, 0x40, 0x00, 0x00, 0x80, 0x3f,  // to 1 3 1
                       0x52, 0x00,                                      // move: both y; the proxy named last
                       0x00, 0x00, 0x80, 0x3f, 0x00, 0x00, 0x00, 0x40,  // y from 1 to 2
                       0x07, 0x01, 0xe5, 0x05, 0x0b, 0x10, 0x1d, 0x16, 0x92, 0x56,  // batch: 1 pair, hash
                       0x02, 0x01,                                                  // destroy: the proxy before
                       0x00};                                                       // end
  EXPECT_EQ(write(ops, header), expected);
  const std::vector<Op> back = read(expected);
  ASSERT_EQ(back.size(), ops.size());
  for (std::size_t i = 0; i < ops.size(); ++i) EXPECT_TRUE(same(back[i], ops[i])) << i;
}

void round_trip(const std::vector<Op>& ops, Scalar scalar) {
  Header header;
  header.scalar = scalar;
  header.about = "round trip";
  const Bytes bytes = write(ops, header);
  const std::vector<Op> back = read(bytes);
  RC_ASSERT(write(back, header) == bytes);
  // Moves to the same box are left out.
  std::vector<Aabb64> boxes;
  std::size_t at = 0;
  for (std::size_t i = 0; i < ops.size(); ++i) {
    if (const auto* const create = std::get_if<Create>(&ops[i])) boxes.push_back(create->box);
    if (const auto* const move = std::get_if<Move>(&ops[i])) {
      const bool idle = same(*move, Move{move->id, boxes[move->id]});
      boxes[move->id] = move->box;
      if (idle) continue;
    }
    RC_ASSERT(at < back.size());
    if (!same(back[at], ops[i]))
      RC_FAIL("op " + std::to_string(i) + ": " + text_of(ops[i], scalar) + " came back as " +
              text_of(back[at], scalar));
    ++at;
  }
  RC_ASSERT(at == back.size());
}

RC_GTEST_PROP(Format, RandomStreamsComeBackInFloat, (std::uint32_t seed)) {
  round_trip(random_ops(seed, 300), Scalar::float32);
}

RC_GTEST_PROP(Format, RandomStreamsComeBackInDouble, (std::uint32_t seed)) {
  std::vector<Op> ops = random_ops(seed, 300);
  for (Op& op : ops)
    if (auto* const move = std::get_if<Move>(&op)) move->box.min[0] += 1e-12;  // not a float
  round_trip(ops, Scalar::float64);
}

TEST(Format, ARestingProxyCostsNothing) {
  const Aabb64 box{{0, 0, 0}, {1, 1, 1}};
  std::vector<Op> ops{Create{0, 0, 1, -1, box}};
  const std::size_t before = write(ops).size();
  for (int i = 0; i < 100; ++i) ops.push_back(Move{0, box});
  EXPECT_EQ(write(ops).size(), before);
}

TEST(Format, TextsThatAreTooLongAreCut) {
  Header header;
  header.about = std::string(5000, 'x');
  const Bytes bytes = write({}, header);
  EXPECT_EQ(Reader(bytes).header().about, std::string(Header::max_about, 'x'));
}

TEST(PairDigest, DoesNotDependOnOrder) {
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < 40; ++a)
    for (std::uint32_t b = a + 1; b < 40; b += 3) pairs.push_back({a, b});
  const PairDigest digest = digest_of(pairs);
  std::shuffle(pairs.begin(), pairs.end(), std::mt19937(7));
  EXPECT_EQ(digest_of(pairs), digest);
  pairs.back().b += 1;
  EXPECT_NE(digest_of(pairs), digest);
}

RC_GTEST_PROP(PairDigest, TellsTheOnePairThatIsMissing, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  PairDigest less;
  for (int i = 0; i < 50; ++i) {
    const std::uint32_t a = static_cast<std::uint32_t>(random()) / 2;
    less.add({a, a + 1 + static_cast<std::uint32_t>(random()) / 2});
  }
  const std::uint32_t a = static_cast<std::uint32_t>(random()) / 2;
  const Pair gone{a, a + 1 + static_cast<std::uint32_t>(random()) / 2};
  PairDigest more = less;
  more.add(gone);
  RC_ASSERT(single_difference(more, less) == gone);
  RC_ASSERT(!single_difference(less, more));
}

}  // namespace
}  // namespace boxstream::record_test
