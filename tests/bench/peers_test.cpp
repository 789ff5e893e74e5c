// SPDX-License-Identifier: MIT
#include "peers/peer.hpp"

#include <gtest/gtest.h>

#include <boxstream/detector.hpp>

#include "batches/batches.hpp"
#include "pair_hash.hpp"

namespace boxstream::bench {
namespace {

PairSummary oracle(const std::vector<Aabb>& boxes) {
  PairSummary summary;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (overlaps(boxes[i], boxes[j])) summary.add(i, j);
  return summary;
}

// A peer that finds too little is a peer that is too fast.
TEST(Peers, FindThePairsThatBruteForceFinds) {
  for (const batches::Batch& batch : batches::all())
    for (const std::size_t n : {0, 1, 2, 63, 64, 65, 500}) {
      const std::vector<Aabb> boxes = batches::make(batch.name, n, 7);
      const PairSummary expected = oracle(boxes);
      for (const PeerConfig& config : make_peers()) {
        std::vector<Pair> pairs(3);
        config.peer->find_pairs(boxes, pairs);
        ASSERT_EQ(summarize(pairs), expected) << config.name << " on " << batch.name << ", n = " << n;
        for (const Pair& pair : pairs) ASSERT_LT(pair.a, pair.b);
      }
    }
}

}  // namespace
}  // namespace boxstream::bench
