// SPDX-License-Identifier: MIT
#include "peers/peer.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "inputs/batches.hpp"
#include "inputs/motion.hpp"
#include "peers/ours.hpp"
#include "peers/pair_hash.hpp"

namespace boxstream::bench {
namespace {

std::vector<Pair> oracle(Span<const Aabb> boxes) {
  std::vector<Pair> pairs;
  for (std::uint32_t i = 0; i < boxes.size(); ++i)
    for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
      if (overlaps(boxes[i], boxes[j])) pairs.push_back({i, j});
  return pairs;
}

/// A peer that is known to miss some may do that, but it finds no other pairs and none twice.
void expect_pairs(std::vector<Pair> pairs, const std::vector<Pair>& expected, const PeerConfig& config,
                  const std::string& where) {
  std::sort(pairs.begin(), pairs.end());
  if (config.known_difference.empty()) {
    ASSERT_EQ(pairs, expected) << config.name << where;
  } else {
    ASSERT_TRUE(std::includes(expected.begin(), expected.end(), pairs.begin(), pairs.end())) << config.name << where;
    ASSERT_TRUE(std::adjacent_find(pairs.begin(), pairs.end()) == pairs.end()) << config.name << where;
  }
}

// A peer that finds too little is a peer that is too fast.
TEST(Peers, FindThePairsThatBruteForceFinds) {
  std::vector<PeerConfig> peers = make_peers(2);
  for (const batches::Batch& batch : batches::all())
    for (const std::size_t n : {0, 1, 2, 64, 65, 300}) {
      const std::vector<Aabb> boxes = batches::make(batch.name, n, 7);
      const std::vector<Pair> expected = oracle(boxes);
      for (const PeerConfig& config : peers) {
        std::vector<Pair> pairs(3);
        config.peer->prepare(boxes);
        config.peer->find_pairs(boxes, pairs);
        config.peer->find_pairs(boxes, pairs);
        config.peer->release();
        for (const Pair& pair : pairs) ASSERT_LT(pair.a, pair.b);
        ASSERT_NO_FATAL_FAILURE(
            expect_pairs(pairs, expected, config, " on " + std::string(batch.name) + ", n = " + std::to_string(n)));
      }
    }
}

// What keeps its structure from frame to frame must not keep pairs that are over.
TEST(Peers, FollowMovingBoxes) {
  std::vector<PeerConfig> peers = make_peers(2);
  peers.push_back({"World", "World", 1, "", make_world(nullptr)});
  for (const MotionName& motion : motions())
    for (const char* name : {"D", "C"})
      for (const PeerConfig& config : peers) {
        if (config.crashes_at == motion.name) continue;
        MovingBoxes moving(batches::make(name, 300, 3), motion.motion, 5);
        std::vector<Pair> pairs;
        config.peer->prepare(moving.boxes());
        config.peer->find_pairs(moving.boxes(), pairs);
        for (int frame = 0; frame < 6; ++frame) {
          moving.next_frame();
          config.peer->next_frame(moving.boxes(), moving.moved(), pairs);
          ASSERT_NO_FATAL_FAILURE(expect_pairs(
              pairs, oracle(moving.boxes()), config,
              " on " + std::string(name) + ", " + std::string(motion.name) + ", frame " + std::to_string(frame)));
        }
        config.peer->release();
      }
}

TEST(Peers, AnUnknownFamilyIsRefusedWithThoseThereAre) {
  try {
    choose_peers(make_peers(2), {"sweep", "nobody"});
    FAIL() << "no exception";
  } catch (const std::invalid_argument& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("'nobody'"), std::string::npos);
    for (const PeerConfig& peer : make_peers(2)) EXPECT_NE(message.find(peer.family), std::string::npos);
  }
  const std::vector<PeerConfig> chosen = choose_peers(make_peers(2), {"sweep"});
  ASSERT_EQ(chosen.size(), 1u);
  EXPECT_EQ(chosen[0].name, "sweep");
}

}  // namespace
}  // namespace boxstream::bench
