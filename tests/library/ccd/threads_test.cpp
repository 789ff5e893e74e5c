// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <thread>

#include "random_shapes.hpp"

namespace boxstream::ccd_test {
namespace {

/// Everything that a run over many pairs gives, as numbers.
std::vector<double> answers() {
  std::vector<double> numbers;
  for (std::uint64_t seed = 1; seed <= 120; ++seed) {
    RandomShapes random(seed);
    const ccd::Shape a = random.shape(static_cast<int>(seed % 6), 1),
                     b = random.shape(static_cast<int>(seed / 6 % 6), 1);
    const ccd::Pose pose_a = random.pose(Vec::Zero(), 1), pose_b = random.pose(Vec::Zero(), 2);
    const ccd::Penetration p = penetration(a, pose_a, b, pose_b);
    const ccd::Distance d = distance(a, pose_a, b, pose_b);
    const double hit = intersect(a, pose_a, b, pose_b).intersects;
    numbers.insert(numbers.end(), {p.depth, p.direction.x(), p.on_a.y(), d.distance, d.on_b.z(), hit});
  }
  return numbers;
}

TEST(Threads, GiveTheSameAnswersAtOnce) {
  std::vector<double> results[4];
  std::vector<std::thread> threads;
  for (auto& result : results) threads.emplace_back([&result] { result = answers(); });
  for (std::thread& thread : threads) thread.join();
  const std::vector<double> alone = answers();
  for (const auto& result : results) EXPECT_EQ(result, alone);
}

}  // namespace
}  // namespace boxstream::ccd_test
