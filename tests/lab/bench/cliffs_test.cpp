// SPDX-License-Identifier: MIT
// Calls whose cliffs are known.
#include <gtest/gtest.h>

#include "cliffs/search.hpp"

namespace boxstream::bench {
namespace {

/// Holds nothing, and is as slow as it says.
struct Idle final : Keeper {
  explicit Idle(int times) : slowness(times) {}
  void fill(Span<const Aabb>) override {}
  void remove(std::uint32_t) override {}
  void add(std::uint32_t, const Aabb&) override {}
  void come(const Aabb&) override {}
  void leave() override {}
  void move(Span<const std::uint32_t>, Span<const Aabb>) override {}
  void update() override {}
  PairSummary pairs(Span<const Aabb>) override { return {}; }

  const int slowness;
};

void work(double steps) {
  volatile double sum = 0;
  for (double i = 0; i < steps; ++i) sum = sum + i;
}

std::uint64_t steps_at_50(Keeper& keeper, const CliffScene& scene) {
  const auto n = static_cast<double>(scene.size());
  work(static_cast<Idle&>(keeper).slowness * 100 * n * (scene.size() >= 50 ? 4 : 1));
  return 0;
}

std::uint64_t by_number(Keeper& keeper, const CliffScene&) {
  return static_cast<std::uint64_t>(static_cast<Idle&>(keeper).slowness);
}

template <int times>
std::unique_ptr<Keeper> make_idle() {
  return std::make_unique<Idle>(times);
}

/// Other work on the machine takes no time from it.
CliffCall idle_call(std::unique_ptr<Keeper> (*make)(), std::unique_ptr<Keeper> (*make_peer)()) {
  return {"", "", "", make, make_peer, steps_at_50, true, measure::Clock::cpu};
}

const auto silent = [](const std::string&) {};

TEST(Cliffs, AJumpIsFoundWhereItIs) {
  const CliffRow row = search_cliffs(idle_call(make_idle<1>, nullptr), {20, 30, 45, 60, 90}, 2, silent);
  ASSERT_EQ(row.cliffs.size(), std::size(histories));
  EXPECT_EQ(row.cliffs[0].from, 45u);
  EXPECT_EQ(row.cliffs[0].to, 60u);
  EXPECT_NEAR(row.largest_jump, 4, 1);
  EXPECT_TRUE(row.equal);
}

TEST(Cliffs, WhatIsSlowerThanItsPeerIsOneRange) {
  const CliffRow row = search_cliffs(idle_call(make_idle<3>, make_idle<1>), {60, 70, 80}, 9, silent);
  ASSERT_EQ(row.cliffs.size(), std::size(histories));
  EXPECT_EQ(row.cliffs[0].from, 60u);
  EXPECT_EQ(row.cliffs[0].to, 80u);
  EXPECT_NEAR(row.least, 1 / 3.0, 0.15);
  EXPECT_EQ(row.below, 3 * std::size(histories));
  ASSERT_EQ(row.fresh.size(), 3u);
  EXPECT_NEAR(row.fresh[1].ratio(), 1 / 3.0, 0.15);
}

TEST(Cliffs, AnswersAreCompared) {
  EXPECT_FALSE(search_cliffs({"", "", "", make_idle<3>, make_idle<1>, by_number}, {5}, 1e9, silent).equal);
  EXPECT_TRUE(search_cliffs({"", "", "", make_idle<2>, make_idle<2>, by_number}, {5}, 1e9, silent).equal);
}

TEST(Cliffs, SizesGoOneByOneAndThenByAFactor) {
  EXPECT_EQ(cliff_sizes(4, 1.5, 14), (std::vector<std::size_t>{1, 2, 3, 4, 6, 9, 14}));
}

}  // namespace
}  // namespace boxstream::bench
