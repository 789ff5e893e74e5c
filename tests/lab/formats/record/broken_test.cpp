// SPDX-License-Identifier: MIT
// Files that are no streams: whatever the bytes are, there is an answer in one line or a stream that can be replayed.
#include <gtest/gtest.h>

#include <random>

#include "formats/record/pair_limit.hpp"
#include "streams.hpp"

namespace boxstream::record_test {
namespace {

using namespace record;

constexpr std::size_t header_size = 8 + 2 + 6 * 4 + 1;  // without a text

/// What is wrong with the stream; empty if nothing is.
std::string reason(const Bytes& bytes) {
  try {
    census_of(bytes);
    return {};
  } catch (const RecordError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("offset ")) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
}

Bytes with(const std::vector<std::uint8_t>& ops) {
  Bytes bytes = write({});
  bytes.pop_back();  // end mark
  bytes.insert(bytes.end(), ops.begin(), ops.end());
  return bytes;
}

Bytes one_proxy_and(const std::vector<std::uint8_t>& ops) {
  Bytes bytes = write({Create{0, 0, 1, -1, {{0, 0, 0}, {1, 1, 1}}}});
  bytes.pop_back();
  bytes.insert(bytes.end(), ops.begin(), ops.end());
  return bytes;
}

TEST(Broken, SizeOfTheHeader) {
  EXPECT_EQ(write({}).size(), header_size + 1);
  EXPECT_EQ(reason(write({})), "");
  EXPECT_EQ(reason(write(one_of_each())), "");
}

TEST(Broken, EveryTruncationIsNamed) {
  for (const Bytes& whole : {write(one_of_each()), write(random_ops(5, 150))})
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const std::string said = reason({whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
      ASSERT_NE(said.find("cut off"), std::string::npos) << size << " of " << whole.size() << " bytes: " << said;
    }
}

TEST(Broken, WhatIsThereOfAPartialFileCanBeReplayed) {
  const std::vector<Op> ops = random_ops(5, 150);
  const Bytes whole = write(ops);
  std::uint64_t batches = 0;
  for (std::size_t size = header_size; size < whole.size(); ++size) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    const Census census = census_of(part, CutOff::is_end);
    ASSERT_GE(census.batches, batches) << size;
    batches = census.batches;
    std::vector<std::unique_ptr<Player>> players;
    players.push_back(std::make_unique<Player>("boxstream", make("boxstream")));
    const ReplayResult result = replay(part, players, CutOff::is_end);
    ASSERT_FALSE(result.difference) << size << ": " << describe(*result.difference, Scalar::float32);
    ASSERT_EQ(result.batches, batches);
  }
  EXPECT_EQ(batches, census_of(whole).batches);
  // Only the end may be missing.
  EXPECT_THROW(census_of(with({0x3f}), CutOff::is_end), RecordError);
}

TEST(Broken, ReasonsAreClearAndGiveThePlace) {
  Bytes magic = write({}), version = magic, scalar = magic, bounds = magic, text = magic, longer = magic;
  magic[0] = 'b';
  version[8] = 2;
  scalar[9] = 5;
  bounds[10 + 3] = 0x7f;  // lower x is huge
  text[header_size - 1] = 0xff;
  longer.push_back(0);
  const std::pair<Bytes, const char*> cases[] = {
      {{'{', '}'}, "offset 0: no boxstream recording"},
      {magic, "offset 0: no boxstream recording"},
      {version, "offset 8: version 2 of the format; this program reads 1"},
      {scalar, "offset 9: 5 bytes to a coordinate; expected 4 or 8"},
      {bounds, "offset 10: bounds from "},
      {text, "offset 34: "},
      {longer, "offset 35: 1 bytes after the end mark"},
      {with({0x3f}), "offset 35: unknown op 0x3f"},
      {with({0x80}), "offset 35: unknown op 0x80"},
      {with({0x02, 0x00}), "offset 35: names a proxy that was not created; there were 0"},
      {with({0x02, 0x01}), "offset 35: names a proxy that was not created; there were 0"},
      {one_proxy_and({0x02, 0x02}), "offset 63: names a proxy that was not created; there were 1"},
      {one_proxy_and({0x40, 0x01}), "offset 63: names a proxy that was not created; there were 1"},
      {one_proxy_and({0x02, 0x00, 0x40, 0x00}), "offset 65: names proxy 0, which is destroyed"},
      {one_proxy_and({0x02, 0x00, 0x02, 0x00}), "offset 65: names proxy 0, which is destroyed"},
      {one_proxy_and({0x02, 0x00, 0x03, 0x00, 0x00, 0x00}), "offset 65: names proxy 0, which is destroyed"},
      {one_proxy_and({0x02, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01}),
       "offset 63: names a proxy that was not created; there were 1"},
      {one_proxy_and({0x02, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x02}),
       "offset 63: a number of more than 64 bits"},
      {one_proxy_and({0x02, 0x80, 0x00}), "offset 63: a number that is longer than it must be"},
      {one_proxy_and({0x03, 0x00, 0x80, 0x80, 0x80, 0x80, 0x10, 0x00}), "offset 63: a number of more than 32 bits"},
  };
  for (const auto& [bytes, said] : cases) EXPECT_TRUE(reason(bytes).starts_with(said)) << reason(bytes) << "\n" << said;
}

TEST(Broken, SaysTheSameAtEachCall) {
  const Bytes bytes = one_proxy_and({0x02, 0x00, 0x40, 0x00, 0x00});
  Reader reader(bytes);
  reader.next();
  reader.next();
  for (int i = 0; i < 3; ++i) EXPECT_THROW(reader.next(), RecordError);
}

/// Lengths are claims; memory is taken for what is there.
TEST(Broken, HostileLengthsTakeNoMemory) {
  Bytes text = write({});
  text.resize(header_size - 1);
  for (const int byte : {0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01})
    text.push_back(static_cast<std::uint8_t>(byte));
  EXPECT_EQ(reason(text), "offset 34: a text of 18446744073709551615 bytes; at most 1000");
  // A batch may claim any number of pairs; it is a difference, not an error.
  const Bytes batch = with({0x07, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01,  //
                            1,    2,    3,    4,    5,    6,    7,    8,    0x00});
  EXPECT_EQ(difference_on(batch, {"boxstream"}),
            "batch 1: recording 18446744073709551615, boxstream 0, search 0; the recording has other pairs");
}

/// Replays what can be read, on the adapter and beside it on Bullet's simplest.
void read_and_replay(const Bytes& bytes, std::uint64_t& readable, std::uint64_t& refused) {
  if (!reason(bytes).empty()) {
    ++refused;
    return;
  }
  ++readable;
  const ReplayResult result = replay_on(bytes, {"boxstream", "simple"});
  if (!result.difference) return;
  // Pairs may well be others than recorded, but the broad-phases and the search have the same.
  EXPECT_EQ(result.difference->party, "recording") << describe(*result.difference, Scalar::float32);
}

TEST(Broken, EverySingleBitFlip) {
  const Bytes whole = write(one_of_each());
  std::uint64_t readable = 0, refused = 0;
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    Bytes bytes = whole;
    bytes[bit / 8] ^= static_cast<std::uint8_t>(1 << bit % 8);
    SCOPED_TRACE(testing::Message() << "bit " << bit);
    read_and_replay(bytes, readable, refused);
  }
  EXPECT_GT(readable, 100u);
  EXPECT_GT(refused, 100u);
}

TEST(Broken, RandomBytesInRandomStreams) {
  std::uint64_t readable = 0, refused = 0;
  for (std::uint32_t seed = 0; seed < 600; ++seed) {
    std::mt19937 random(seed);
    Bytes bytes = write(random_ops(seed, 60));
    for (int i = 0; i < 2; ++i) bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    read_and_replay(bytes, readable, refused);
  }
  EXPECT_GT(readable, 20u);
  EXPECT_GT(refused, 20u);
}

}  // namespace
}  // namespace boxstream::record_test
