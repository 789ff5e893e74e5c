// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "inputs/batches.hpp"
#include "inputs/set_cases.hpp"
#include "peers/cross.hpp"

namespace boxstream::bench {
namespace {

std::vector<Pair> all_pairs(const TwoSets& sets) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < sets.a.size(); ++i)
    for (std::uint32_t j = 0; j < sets.b.size(); ++j)
      if (overlaps(sets.a[i], sets.b[j])) pairs.push_back({i, j});
  return pairs;
}

// A peer that finds too little is a peer that is too fast.
TEST(CrossPeers, FindThePairsThatBruteForceFinds) {
  const std::vector<CrossPeerConfig> peers = make_cross_peers();
  const std::vector<Aabb> tight = batches::make("T", 600, 3);
  const TwoSets cases[] = {few_against_many(1, 700, 1),
                           few_against_many(30, 1100, 2),
                           few_against_many(900, 40, 3),
                           turned_meshes(2000),
                           {tight, batches::make("T", 513, 4)},
                           {tight, {}},
                           {{}, tight}};
  for (const TwoSets& sets : cases)
    for (const CrossPeerConfig& config : peers) {
      std::vector<Pair> pairs(3);
      config.find_pairs(sets.a, sets.b, pairs);
      std::sort(pairs.begin(), pairs.end());
      ASSERT_EQ(pairs, all_pairs(sets)) << config.name << ", " << sets.a.size() << " and " << sets.b.size();
    }
}

TEST(SetCases, PartsAreWhatTheFiltersAccept) {
  for (const Filtered& filtered : {mostly_static(500, 1), ten_groups(500, 1)}) {
    std::vector<Pair> parts, accepted;
    for (const Filtered::Part& part : filtered.parts) {
      for (const std::uint32_t a : part.a)
        for (const std::uint32_t b : part.b.empty() ? part.a : part.b)
          if (!part.b.empty() || a < b) parts.push_back({std::min(a, b), std::max(a, b)});
    }
    for (std::uint32_t a = 0; a < 500; ++a)
      for (std::uint32_t b = a + 1; b < 500; ++b)
        if (accepts(filtered.filters[a], filtered.filters[b])) accepted.push_back({a, b});
    std::sort(parts.begin(), parts.end());
    EXPECT_EQ(parts, accepted);
  }
}

}  // namespace
}  // namespace boxstream::bench
