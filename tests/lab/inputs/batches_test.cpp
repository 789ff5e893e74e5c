// SPDX-License-Identifier: MIT
#include "inputs/batches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>

namespace boxstream::batches {
namespace {

template <class S>
std::uint64_t brute_force_pairs(const std::vector<BasicAabb<S>>& boxes) {
  std::uint64_t pairs = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j) pairs += overlaps(boxes[i], boxes[j]);
  return pairs;
}

/// In the manner of Fowler-Noll-Vo, over the bits of the bounds.
std::uint64_t fingerprint(const std::vector<Aabb64>& boxes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Aabb64& box : boxes) {
    std::uint64_t bits[6];
    std::memcpy(bits, &box, sizeof bits);
    for (const std::uint64_t word : bits) {
      hash = (hash ^ word) * 0x100000001b3u;
      hash ^= hash >> 32;  // round numbers have nothing in their low bits
    }
  }
  return hash;
}

double mean_side(const std::vector<Aabb64>& boxes, int d) {
  double sum = 0;
  for (const Aabb64& box : boxes) sum += box.max[d] - box.min[d];
  return sum / static_cast<double>(boxes.size());
}

class EachBatch : public testing::TestWithParam<Batch> {};

TEST_P(EachBatch, HasExactlyNValidBoxes) {
  for (const std::size_t n : {0, 1, 2, 3, 7, 8, 9, 64, 499, 500, 501, 1000}) {
    const std::vector<Aabb> boxes = make(GetParam().name, n, 5);
    EXPECT_EQ(boxes.size(), n);
    EXPECT_TRUE(std::all_of(boxes.begin(), boxes.end(), [](const Aabb& box) { return is_valid(box); })) << n;
    const std::vector<Aabb64> exact = make64(GetParam().name, n, 5);
    EXPECT_EQ(exact.size(), n);
    EXPECT_TRUE(std::all_of(exact.begin(), exact.end(), [](const Aabb64& box) { return is_valid(box); })) << n;
  }
}

TEST_P(EachBatch, IsAPureFunctionOfItsArguments) {
  const std::string_view name = GetParam().name;
  EXPECT_EQ(make(name, 777, 3), make(name, 777, 3));
  EXPECT_EQ(make64(name, 777, 3), make64(name, 777, 3));
  if (name != "I") {
    EXPECT_NE(make(name, 777, 3), make(name, 777, 4));
  }
}

TEST_P(EachBatch, FloatBoxesAreTheDoubleOnesRounded) {
  const std::vector<Aabb> boxes = make(GetParam().name, 500, 9);
  const std::vector<Aabb64> exact = make64(GetParam().name, 500, 9);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      ASSERT_EQ(boxes[i].min[d], static_cast<float>(exact[i].min[d]));
      ASSERT_EQ(boxes[i].max[d], static_cast<float>(exact[i].max[d]));
    }
}

TEST_P(EachBatch, HasTheDensityItStates) {
  const Batch& batch = GetParam();
  for (const std::size_t n : {1000, 3000})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const double count = static_cast<double>(n);
      const double unit = batch.quadratic ? count * (count - 1) / 2 : count;
      const double density = static_cast<double>(brute_force_pairs(make(batch.name, n, seed))) / unit;
      EXPECT_GE(density, batch.density_low) << "n = " << n << ", seed = " << seed;
      EXPECT_LE(density, batch.density_high) << "n = " << n << ", seed = " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Batches, EachBatch, testing::ValuesIn(all().begin(), all().end()),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(Batches, UnknownNameIsRefusedWithTheNamesThereAre) {
  try {
    make("nonsense", 10, 1);
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("'nonsense'"), std::string::npos);
    for (const Batch& batch : all()) EXPECT_NE(std::string(error.what()).find(batch.name), std::string::npos);
  }
}

TEST(Batches, BalancedIsThePapersDistribution) {
  const std::vector<Aabb64> boxes = make64("U", 8000, 1);
  for (const Aabb64& box : boxes)
    for (int d = 0; d < 3; ++d) {
      ASSERT_EQ(box.min[d], std::floor(box.min[d]));
      ASSERT_GE(box.min[d], 1);
      ASSERT_LE(box.min[d], 8000 - 400);
      ASSERT_GE(box.max[d] - box.min[d], 1);
      ASSERT_LE(box.max[d] - box.min[d], 400);
    }
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(mean_side(boxes, d), 200.5, 5);
}

TEST(Batches, SkewedOnesDifferInTheAxisThatSeparates) {
  const struct {
    const char* name;
    double longest[3];
  } cases[] = {{"W1", {10000, 10000, 1}}, {"W2", {10000, 1, 10000}}, {"W3", {1, 10000, 10000}},
               {"W4", {10000, 100, 100}}, {"W5", {100, 10000, 100}}, {"W6", {100, 100, 10000}}};
  for (const auto& c : cases) {
    const std::vector<Aabb64> boxes = make64(c.name, 10000, 1);
    for (int d = 0; d < 3; ++d) {
      EXPECT_NEAR(mean_side(boxes, d), (1 + c.longest[d]) / 2, 0.03 * c.longest[d]) << c.name << d;
      // A longest side of n leaves one place to start from: all overlap on that axis.
      const bool all_overlap = std::all_of(boxes.begin(), boxes.end(), [&](const Aabb64& b) { return b.min[d] == 1; });
      EXPECT_EQ(all_overlap, c.longest[d] == 10000) << c.name << d;
    }
  }
}

TEST(Batches, SphereBoxesSitOnTheSurface) {
  for (const Aabb64& box : make64("S", 2000, 1)) {
    double square = 0;
    for (int d = 0; d < 3; ++d) {
      const double centre = (box.min[d] + box.max[d]) / 2;
      square += centre * centre;
      ASSERT_GE(box.max[d] - box.min[d], 1 - 1e-9);
      ASSERT_LE(box.max[d] - box.min[d], 44 + 1e-9);
    }
    ASSERT_NEAR(std::sqrt(square), 1000, 1e-6);
  }
}

TEST(Batches, MixedSizesAreLogUniformOverThreeDecades) {
  std::size_t decade[3] = {0, 0, 0};
  const std::vector<Aabb64> boxes = make64("M", 9000, 1);
  for (const Aabb64& box : boxes) {
    double mean = 0;
    for (int d = 0; d < 3; ++d) mean += (box.max[d] - box.min[d]) / 3;
    ++decade[std::clamp(static_cast<int>(std::floor(std::log10(mean / 0.01))), 0, 2)];
  }
  for (const std::size_t count : decade) EXPECT_NEAR(static_cast<double>(count), 3000, 200);
}

TEST(Batches, FlatLayersAreThinInTheirAxis) {
  const char* names[3] = {"Px", "Py", "P"};
  for (int thin = 0; thin < 3; ++thin) {
    double highest[3] = {0, 0, 0};
    for (const Aabb64& box : make64(names[thin], 2000, 1))
      for (int d = 0; d < 3; ++d) {
        ASSERT_GE(box.min[d], 0);
        highest[d] = std::max(highest[d], box.max[d]);
      }
    for (int d = 0; d < 3; ++d) {
      EXPECT_EQ(highest[d] <= 2.5, d == thin);
    }
  }
}

TEST(Batches, RodsHaveOneLongSideAndThirdsOfEachDirection) {
  std::size_t along[3] = {0, 0, 0};
  for (const Aabb64& box : make64("R", 30000, 1)) {
    int is_long = 0;
    for (int d = 0; d < 3; ++d)
      if (box.max[d] - box.min[d] > 100) {
        ++along[d];
        ++is_long;
      }
    ASSERT_EQ(is_long, 1);
  }
  for (const std::size_t count : along) EXPECT_EQ(count, 10000u);
}

TEST(Batches, GridCellsHave26NeighboursInside) {
  const std::vector<Aabb> boxes = make("G", 125, 1);
  const auto centre = std::find_if(boxes.begin(), boxes.end(),
                                   [](const Aabb& b) { return b.min[0] == 2 && b.min[1] == 2 && b.min[2] == 2; });
  ASSERT_NE(centre, boxes.end());
  EXPECT_EQ(std::count_if(boxes.begin(), boxes.end(), [&](const Aabb& b) { return overlaps(b, *centre); }), 27);
}

TEST(Batches, LatticeHasEqualAndDegenerateBoxes) {
  std::vector<Aabb> boxes = make("T", 2000, 1);
  std::size_t flat = 0, equal = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int d = 0; d < 3; ++d) ASSERT_EQ(boxes[i].min[d], std::floor(boxes[i].min[d]));
    flat += boxes[i].min[0] == boxes[i].max[0];
    for (std::size_t j = 0; j < i; ++j) equal += boxes[i] == boxes[j];
  }
  EXPECT_GT(flat, 500u);
  EXPECT_GT(equal, 0u);
}

TEST(Batches, DustHasAWorldBoxAndPlanesToTheFarEnd) {
  const std::vector<Aabb> boxes = make("X", 1000, 1);
  std::size_t far = 0, touching_all = 0;
  for (const Aabb& box : boxes) {
    far += box.max[0] == 1e18f || box.min[0] == -1e18f;
    touching_all += std::all_of(boxes.begin(), boxes.end(), [&](const Aabb& other) { return overlaps(box, other); });
  }
  EXPECT_EQ(far, 7u);
  EXPECT_EQ(touching_all, 2u);
}

// Other platforms must make these bits too. The numbers were taken from x86-64, g++ 12.
TEST(Batches, BitsAreTheSameOnEveryPlatform) {
  const struct {
    const char* name;
    std::uint64_t hash;
  } cases[] = {
      {"U", 0xf2fc81e3f642fee9u},        {"D", 0x15959831aa019570u},          {"S", 0x0146a2afbc8dbb44u},
      {"M", 0x624175b2e7b5e94fu},        {"M2", 0x933c68bd603feeabu},         {"P", 0xdbfc5f4261de7339u},
      {"Px", 0x6ae902f613b6e6c4u},       {"Py", 0xbfc997cdf7bbb532u},         {"C", 0x7e54ba16dbe71824u},
      {"W1", 0x4e8a328beb5190c0u},       {"W2", 0x3cb618ce006ddeb7u},         {"W3", 0xd95b95d70c0d94f2u},
      {"W4", 0x291a808ea55fe799u},       {"W5", 0x7f7a843271dfa8fcu},         {"W6", 0x825ba1eb96f886a2u},
      {"R", 0x8b2ac99071e733b8u},        {"G", 0x2ee3f2c7d6427126u},          {"T", 0x73aec7cbe7a4171au},
      {"Z", 0xcd0a866816ebb2afu},        {"X", 0xcc118406127c058au},          {"I", 0x5f7b0a9e88e769e5u},
      {"N", 0x1dd784f1607c3120u},        {"lattice", 0x2a850735d40143eeu},    {"lattice_j", 0x971f5454dc52a6e9u},
      {"scaffold", 0xa665c886d073fee9u}, {"scaffold_j", 0x49f6ffb22216a3e3u}, {"heap", 0x26e5fe4d288b75b4u},
      {"heaps", 0xd63b65b9074cd5deu},    {"rods", 0xa5714d0759020051u},       {"graded", 0x77f43531a3826b20u},
      {"diag", 0xdea4e7994f36d907u},     {"city", 0x7f8c9e9cc0e44feeu},       {"voxel", 0xe3d40fa27583ea28u},
      {"pareto", 0xe3e33762e76d92dbu}};
  for (const auto& c : cases) EXPECT_EQ(fingerprint(make64(c.name, 1000, 1)), c.hash) << c.name;
}

}  // namespace
}  // namespace boxstream::batches
