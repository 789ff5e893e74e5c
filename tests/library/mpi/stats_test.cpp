// SPDX-License-Identifier: MIT
// What ranks get to do, and what they send for it.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "inputs/batches.hpp"
#include "shares.hpp"

namespace boxstream::mpi_test {
namespace {

mpi::Stats find(const Boxes<float>& all, Way way) {
  const Share<float> share(all, way);
  return mpi::stream_pairs(MPI_COMM_WORLD, share.boxes, share.ids, [](Span<const WidePair>) { return true; });
}

TEST(Stats, RanksSearchAboutEquallyManyBoxes) {
  for (const char* name : {"U", "C", "heap", "lattice"}) {
    const auto received = from_all(find(batches::make(name, 100000, 1), Way::round_robin).received);
    const double mean = std::accumulate(received.begin(), received.end(), 0.0) / size();
    EXPECT_LT(static_cast<double>(*std::max_element(received.begin(), received.end())), 1.2 * mean) << name;
  }
}

/// Of a rank that has everything, and of others that have nothing.
TEST(Stats, BytesAreThoseOfTheSampleAndOfBoxesThatOthersNeed) {
  const mpi::Stats own = find(batches::make("U", 30000, 1), Way::all_on_last);
  const auto all = from_all(own);
  if (rank() != size() - 1) {
    EXPECT_EQ(own.bytes_sent + own.messages_sent, 0u);
    return;
  }
  std::uint64_t boxes = 0, others = 0;
  for (int i = 0; i < size() - 1; ++i) {
    boxes += all[static_cast<std::size_t>(i)].received;
    ++others;
  }
  EXPECT_EQ(own.bytes_sent, boxes * 32 + others * own.sampled * 24);
  EXPECT_EQ(own.messages_sent, 2 * others);
  EXPECT_LT(own.sampled, 700 * (others + 1));
}

TEST(Stats, BoxesAreSentToThoseWhosePartTheyTouch) {
  const auto boxes = batches::make("heap", 30000, 1);
  const mpi::Stats own = find(boxes, Way::sorted);
  std::uint64_t touching = 0;
  for (const Aabb& box : boxes) {
    bool touches = true;
    for (int d = 0; d < 3; ++d) touches &= box.min[d] < own.part.max[d] && box.max[d] >= own.part.min[d];
    touching += touches ? 1 : 0;
  }
  EXPECT_EQ(own.received, touching);
}

TEST(Stats, OneRankDoesWhatNothingSeparates) {
  const auto all = from_all(find(Boxes<float>(1000, {{0, 0, 0}, {1, 1, 1}}), Way::round_robin));
  std::uint64_t busy = 0;
  for (const mpi::Stats& stats : all) {
    busy += stats.pairs == 1000 * 999 / 2 ? 1 : 0;
    EXPECT_EQ(stats.pairs == 0, stats.part.min[0] > stats.part.max[0]);
  }
  EXPECT_EQ(busy, 1u);
}

}  // namespace
}  // namespace boxstream::mpi_test
