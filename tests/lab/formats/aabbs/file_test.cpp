// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "formats/aabbs/reader.hpp"
#include "formats/aabbs/writer.hpp"
#include "heap_watch.hpp"

namespace boxstream::aabbs {
namespace {

namespace heap_watch = boxstream::tests::heap_watch;

Aabb box(float x) {
  return {{x, x + 0.25f, -x}, {x + 1, x + 1.5f, -x + 2}};
}

Header header(std::uint32_t objects, std::uint32_t steps) {
  return {"Brownian", "Cubes", objects, steps, {{-5, -5, -5}, {5, 5, 5}}};
}

std::string written(std::uint32_t objects, std::uint32_t steps) {
  std::ostringstream out;
  Writer writer(out, header(objects, steps));
  for (std::uint32_t f = 0; f <= steps; ++f) {
    std::vector<Aabb> boxes;
    for (std::uint32_t i = 0; i < objects; ++i) boxes.push_back(box(static_cast<float>(10 * f + i)));
    writer.frame(boxes);
  }
  writer.finish();
  return out.str();
}

std::string with_word(std::string bytes, std::size_t at, std::uint32_t word) {
  for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(word >> 8 * i & 0xff);
  return bytes;
}

/// What is wrong with the bytes: read as a file, whose size is known, or as a pipe, where it is not.
std::string complaint(const std::string& bytes, bool seekable = true) {
  struct Pipe : std::stringbuf {
    using std::stringbuf::stringbuf;
    pos_type seekoff(off_type, std::ios::seekdir, std::ios::openmode) override { return pos_type(off_type(-1)); }
  };
  std::stringbuf file(bytes);
  Pipe pipe(bytes);
  std::istream in(seekable ? &file : static_cast<std::streambuf*>(&pipe));
  try {
    Reader reader(in);
    std::vector<Aabb> boxes;
    while (reader.next(boxes)) {
    }
  } catch (const AabbsError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

constexpr std::size_t objects_at = 256, steps_at = 260, padding_at = 264, world_at = 272;

TEST(AabbsFile, HasTheBytesThatBroadmarkReads) {
  const std::string bytes = written(2, 3);
  ASSERT_EQ(bytes.size(), 304u + 4 * 2 * 32);
  EXPECT_EQ(bytes.substr(0, 8), "Brownian");
  EXPECT_EQ(bytes.substr(8, 120), std::string(120, '\0'));
  EXPECT_EQ(bytes.substr(128, 6), std::string("Cubes\0", 6));
  EXPECT_EQ(bytes.substr(objects_at, 16), std::string("\2\0\0\0\3\0\0\0\0\0\0\0\0\0\0\0", 16));
  // -5 in all corners of the low end, and a fourth float of zero.
  EXPECT_EQ(bytes.substr(world_at, 16), std::string("\0\0\xa0\xc0\0\0\xa0\xc0\0\0\xa0\xc0\0\0\0\0", 16));
  // The second object of the second frame.
  EXPECT_EQ(bytes.substr(304 + 3 * 32, 4), std::string("\0\0\x30\x41", 4));  // 11
}

TEST(AabbsFile, ReadsWhatItWrote) {
  for (const bool without_start : {false, true}) {
    std::string bytes = written(3, 4);
    if (without_start) bytes.erase(304, 3 * 32);
    std::istringstream in(bytes);
    Reader reader(in);
    EXPECT_EQ(reader.header().scene, "Brownian");
    EXPECT_EQ(reader.header().type, "Cubes");
    EXPECT_EQ(reader.header().objects, 3u);
    EXPECT_EQ(reader.header().steps, 4u);
    EXPECT_EQ(reader.header().world, (Aabb{{-5, -5, -5}, {5, 5, 5}}));
    std::vector<Aabb> boxes;
    for (std::uint32_t f = without_start ? 1 : 0; f <= 4; ++f) {
      ASSERT_TRUE(reader.next(boxes));
      ASSERT_EQ(boxes.size(), 3u);
      for (std::uint32_t i = 0; i < 3; ++i) EXPECT_EQ(boxes[i], box(static_cast<float>(10 * f + i)));
    }
    EXPECT_FALSE(reader.next(boxes));
    EXPECT_FALSE(reader.next(boxes));
    EXPECT_EQ(reader.frames_read(), without_start ? 4u : 5u);
  }
}

TEST(AabbsFile, KeepsOddBoxesAsTheyAre) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const std::vector<Aabb> odd{
      {{1, 1, 1}, {-1, -1, -1}}, {{-inf, -0.0f, 1e-42f}, {inf, 0, 3.4e38f}}, {{std::nanf(""), 0, 0}, {1, 1, 1}}};
  std::stringstream file;
  Writer writer(file, header(3, 1));
  writer.frame(odd);
  writer.frame(odd);
  writer.finish();
  Reader reader(file);
  std::vector<Aabb> boxes;
  ASSERT_TRUE(reader.next(boxes));
  EXPECT_EQ(boxes[0], odd[0]);
  EXPECT_EQ(boxes[1], odd[1]);
  EXPECT_TRUE(std::signbit(boxes[1].min[1]));
  EXPECT_TRUE(std::isnan(boxes[2].min[0]));
}

TEST(AabbsFile, MoreBoxesThanAreReadAtOnce) {
  EXPECT_EQ(complaint(written(10'000, 1)), "");
  EXPECT_EQ(complaint(written(8192, 1), false), "");
}

TEST(AabbsFile, LongTextsAreCutOff) {
  std::stringstream file;
  Header long_names = header(1, 1);
  long_names.scene = std::string(500, 's');
  Writer writer(file, long_names);
  writer.frame(std::vector<Aabb>{box(1)});
  writer.frame(std::vector<Aabb>{box(1)});
  EXPECT_EQ(Reader(file).header().scene, std::string(127, 's'));
}

TEST(AabbsFile, BrokenHeadersAreRefusedWithAReason) {
  const std::string good = written(2, 3);
  EXPECT_EQ(complaint(good), "");
  EXPECT_EQ(complaint(""), "0 bytes; the header alone takes 304");
  EXPECT_EQ(complaint(good.substr(0, 303)), "303 bytes; the header alone takes 304");
  EXPECT_EQ(complaint(std::string(128, 'x') + good.substr(128)), "the name of the scene does not end within 128 bytes");
  EXPECT_EQ(complaint(good.substr(0, 128) + std::string(128, 'x') + good.substr(256)),
            "the kind of objects does not end within 128 bytes");
  EXPECT_EQ(complaint(with_word(good, objects_at, 0)), "0 objects; expected at least 1");
  EXPECT_EQ(complaint(with_word(good, objects_at, 0xfffffffe)), "-2 objects; expected at least 1");
  EXPECT_EQ(complaint(with_word(good, steps_at, 0)), "0 steps; expected at least 1");
  EXPECT_EQ(complaint(with_word(good, steps_at, 0x80000000)), "-2147483648 steps; expected at least 1");
  EXPECT_EQ(complaint(with_word(good, padding_at + 4, 1)), "the two words behind the counts are not 0");
  EXPECT_EQ(complaint(with_word(good, world_at, 0x7fc00000)), "the box of the world has a NaN or min > max");
  EXPECT_EQ(complaint(with_word(good, world_at, 0x7f800000)), "the box of the world has a NaN or min > max");
}

TEST(AabbsFile, WrongSizesAreRefused) {
  const std::string good = written(2, 3);
  const std::string expected = " bytes of boxes, but 2 objects in 1 + 3 frames would take 256";
  for (const std::size_t off : {1u, 31u, 32u, 96u, 129u, 256u})
    EXPECT_EQ(complaint(good.substr(0, good.size() - off)), std::to_string(256 - off) + expected);
  EXPECT_EQ(complaint(good + "x"), "257" + expected);
  EXPECT_EQ(complaint(good + std::string(64, '\0')), "320" + expected);
}

TEST(AabbsFile, WrongSizesOfPipesAreFoundOnTheWay) {
  const std::string good = written(2, 3);
  EXPECT_EQ(complaint(good, false), "");
  EXPECT_EQ(complaint(good.substr(0, good.size() - 64), false), "") << "without the start";
  EXPECT_EQ(complaint(good.substr(0, good.size() - 1), false), "cut off in frame 4 of 1 + 3");
  EXPECT_EQ(complaint(good.substr(0, good.size() - 65), false), "cut off in frame 3 of 1 + 3");
  EXPECT_EQ(complaint(good.substr(0, good.size() - 128), false), "cut off in frame 3 of 1 + 3");
  EXPECT_EQ(complaint(good + "x", false), "more bytes than the boxes of 2 objects in 1 + 3 frames");
}

TEST(AabbsFile, HugeCountsTakeNoMemory) {
  std::string huge = with_word(written(2, 3), objects_at, most);
  huge = with_word(huge, steps_at, most);
  for (const bool seekable : {true, false}) {
    heap_watch::reset_peak();
    const std::int64_t before = heap_watch::live_bytes();
    EXPECT_NE(complaint(huge, seekable), "");
    EXPECT_LT(heap_watch::peak_bytes() - before, 1 << 20);
  }
  EXPECT_EQ(complaint(huge, false), "cut off in frame 1 of 1 + 2147483647");
}

TEST(AabbsFile, AnyCutAndAnyFlippedByteIsReadOrRefused) {
  const std::string good = written(1, 2);
  for (std::size_t size = 0; size < good.size(); ++size)
    for (const bool seekable : {true, false})
      EXPECT_EQ(complaint(good.substr(0, size), seekable).empty(), size == good.size() - 32) << size;
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string flipped = good;
    flipped[at] = static_cast<char>(~flipped[at]);
    complaint(flipped);
    complaint(flipped, false);
  }
}

TEST(AabbsFile, WriterRefusesWhatNobodyCouldRead) {
  std::ostringstream out;
  EXPECT_THROW(Writer(out, header(0, 1)), std::invalid_argument);
  EXPECT_THROW(Writer(out, header(1, 0)), std::invalid_argument);
  EXPECT_THROW(Writer(out, header(1, 0x80000000)), std::invalid_argument);
  Header inverted = header(1, 1);
  inverted.world.min[1] = 6;
  EXPECT_THROW(Writer(out, inverted), std::invalid_argument);
  EXPECT_EQ(out.str(), "");
  Writer writer(out, header(1, 1));
  const std::vector<Aabb> one{box(0)}, two{box(0), box(1)};
  EXPECT_THROW(writer.frame(two), std::invalid_argument);
  writer.frame(one);
  EXPECT_THROW(writer.finish(), std::logic_error);
  writer.frame(one);
  EXPECT_THROW(writer.frame(one), std::invalid_argument);
  writer.finish();
  out.setstate(std::ios::badbit);
  EXPECT_THROW(writer.finish(), std::runtime_error);
}

}  // namespace
}  // namespace boxstream::aabbs
