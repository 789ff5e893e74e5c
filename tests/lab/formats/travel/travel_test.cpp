// SPDX-License-Identifier: MIT
// The files beside this were written on x86-64. Every system reads the same from them, and writes the same bytes.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "formats/aabbs/reader.hpp"
#include "formats/aabbs/writer.hpp"
#include "formats/record/op.hpp"
#include "formats/record/reader.hpp"
#include "formats/record/writer.hpp"
#include "source_path.hpp"

namespace boxstream::travel_test {
namespace {

using namespace record;

constexpr float infinite = std::numeric_limits<float>::infinity(),
                not_a_number = std::numeric_limits<float>::quiet_NaN(), denormal = 0x1.8p-140F,
                largest = std::numeric_limits<float>::max();

/// Numbers whose bytes differ from each other, and those that some arithmetic does not carry through.
const Aabb boxes[] = {{{0.1F, -2.7182817F, 3.1415927F}, {1234.5678F, 0, 1e20F}},
                      {{-0.0F, denormal, -denormal}, {largest, infinite, not_a_number}}};

std::string bytes_of(const std::string& name) {
  std::ifstream in(tests::source_path("tests/lab/formats/travel/files/" + name), std::ios::binary);
  EXPECT_TRUE(in) << "no file " << name;
  return {std::istreambuf_iterator<char>(in), {}};
}

/// What is written stays where a new version of the format can take it from.
void expect_bytes_of(const std::string& name, const std::string& written) {
  const std::string here = testing::TempDir() + name;
  const bool same = written == bytes_of(name);
  if (!same) std::ofstream(here, std::ios::binary) << written;
  EXPECT_TRUE(same) << "other bytes than those of " << name << ": " << here;
}

std::string bits_of(const std::vector<Aabb>& some) {
  return {reinterpret_cast<const char*>(some.data()), some.size() * sizeof(Aabb)};
}

const aabbs::Header frames_header{"Travelling", "Cubes", 2, 1, {{-5, -5, -5}, {5, 5, 5}}};
const std::vector<Aabb> frames[] = {{boxes[0], boxes[1]}, {boxes[1], boxes[0]}};

TEST(Frames, AreWrittenAsElsewhere) {
  std::ostringstream out;
  aabbs::Writer writer(out, frames_header);
  for (const auto& frame : frames) writer.frame(frame);
  writer.finish();
  expect_bytes_of("frames.aabbs", out.str());
}

TEST(Frames, AreReadAsElsewhere) {
  std::istringstream in(bytes_of("frames.aabbs"));
  aabbs::Reader reader(in);
  EXPECT_EQ(reader.header().scene, frames_header.scene);
  EXPECT_EQ(reader.header().objects, 2u);
  std::vector<Aabb> found;
  for (const auto& frame : frames) {
    ASSERT_TRUE(reader.next(found));
    EXPECT_EQ(bits_of(found), bits_of(frame));
  }
  EXPECT_FALSE(reader.next(found));
}

Aabb64 box(int i) {
  const Aabb& b = boxes[i];
  return {{b.min[0], b.min[1], b.min[2]}, {b.max[0], b.max[1], b.max[2]}};
}

/// One of each.
const std::vector<Op> calls = {
    Create{0, 0, 1, -1, box(0)},
    Create{1, 8, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max(), box(0)},
    Move{1, box(1)},
    Refilter{0, 300, -70000},
    BoxQuery{box(1)},
    RayQuery{{1, 2, 3}, {-1, -2, -3}, {-0.5, -0.25, infinite}, largest, {}, {}},
    RayQuery{{1, 2, 3}, {-1, -2, -3}, {-0.5, -0.25, infinite}, 7, {-1, -1, -1}, {0.5, 0.5, 0.5}},
    Batch{digest_of({{0, 1}})},
    Destroy{0},
    ResetPool{}};

struct Recording : testing::TestWithParam<Scalar> {
  static std::string name() { return GetParam() == Scalar::float32 ? "calls_float.bsrec" : "calls_double.bsrec"; }
  static Header header() { return {GetParam(), {{-1, -1, -1}, {1, 1, 1}}, "travelling"}; }
};

TEST_P(Recording, IsWrittenAsElsewhere) {
  std::ostringstream out;
  Writer writer(out, header());
  for (const Op& call : calls) writer.write(call);
  writer.finish();
  expect_bytes_of(name(), out.str());
}

TEST_P(Recording, IsReadAsElsewhere) {
  const std::string bytes = bytes_of(name());
  Reader reader({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  EXPECT_EQ(text_of(reader.header()), text_of(header()));
  for (const Op& call : calls) {
    const auto found = reader.next();
    ASSERT_TRUE(found);
    EXPECT_EQ(text_of(*found, GetParam()), text_of(call, GetParam()));
  }
  EXPECT_FALSE(reader.next());
}

INSTANTIATE_TEST_SUITE_P(OfEachPrecision, Recording, testing::Values(Scalar::float32, Scalar::float64));

}  // namespace
}  // namespace boxstream::travel_test
