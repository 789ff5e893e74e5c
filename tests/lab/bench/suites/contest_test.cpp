// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "suites/batch_contest.hpp"
#include "suites/frame_contest.hpp"
#include "suites/suites.hpp"

namespace boxstream::bench {
namespace {

/// Right in every way but one.
class Liar final : public Peer {
 public:
  enum class Lie { none, misses_a_pair, repeats_a_pair, swaps_a_pair, keeps_old_pairs };
  explicit Liar(Lie lie) : lie_(lie) {}

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      for (std::uint32_t j = i + 1; j < boxes.size(); ++j)
        if (overlaps(boxes[i], boxes[j])) pairs.push_back({i, j});
    if (lie_ == Lie::misses_a_pair) pairs.pop_back();
    if (lie_ == Lie::repeats_a_pair) pairs.push_back(pairs.front());
    if (lie_ == Lie::swaps_a_pair) pairs.front() = pairs.back();
  }

  void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t>, std::vector<Pair>& pairs) override {
    if (lie_ != Lie::keeps_old_pairs) find_pairs(boxes, pairs);
  }

 private:
  Lie lie_;
};

std::vector<PeerConfig> one_peer(Liar::Lie lie, const std::string& known_difference = "") {
  std::vector<PeerConfig> peers;
  peers.push_back({"liar", "liar", 1, known_difference, std::make_unique<Liar>(lie)});
  return peers;
}

Options tiny() {
  Options options;
  options.frames = 4;
  options.interleaving.repeats = 1;
  options.interleaving.min_sample_ms = 0;
  return options;
}

Row batch_row(std::vector<PeerConfig> peers) {
  const Options options = tiny();
  Report report(describe_machine());
  Progress progress;
  Ours ours(make_detector);
  BatchContest({"batch", options, ours, peers, report, progress}).run("D", 200);
  EXPECT_EQ(report.rows().size(), 1u);
  return report.rows().at(0);
}

Row frames_row(std::vector<PeerConfig> peers) {
  const Options options = tiny();
  Report report(describe_machine());
  Progress progress;
  Ours ours(make_world);
  FrameContest({"frames", options, ours, peers, report, progress}).run("D:teleport", 200);
  EXPECT_EQ(report.rows().size(), 1u);
  return report.rows().at(0);
}

TEST(Contests, HonestPeersPass) {
  for (const Row& row : {batch_row(one_peer(Liar::Lie::none)), frames_row(one_peer(Liar::Lie::none))}) {
    EXPECT_EQ(row.pairs_equal, true);
    EXPECT_FALSE(row.failed());
    EXPECT_GT(row.k, 100u);
    EXPECT_GT(row.ours_ms, 0);
    EXPECT_GT(row.peer_ms, 0);
  }
}

TEST(Contests, WrongPairsAreNoticed) {
  for (const Liar::Lie lie : {Liar::Lie::misses_a_pair, Liar::Lie::repeats_a_pair, Liar::Lie::swaps_a_pair}) {
    EXPECT_TRUE(batch_row(one_peer(lie)).failed());
    EXPECT_TRUE(frames_row(one_peer(lie)).failed());
  }
  EXPECT_TRUE(frames_row(one_peer(Liar::Lie::keeps_old_pairs)).failed());
}

TEST(Contests, AKnownDifferenceIsShownButNoFailure) {
  const Row row = batch_row(one_peer(Liar::Lie::misses_a_pair, "is known for it"));
  EXPECT_EQ(row.pairs_equal, false);
  EXPECT_EQ(row.known_difference, "is known for it");
  EXPECT_FALSE(row.failed());
}

TEST(Contests, TheBestOfAFamilyIsReported) {
  /// Takes longer than the other configuration of its family.
  class Slow final : public Peer {
   public:
    void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
      for (int i = 0; i < 50; ++i) honest_.find_pairs(boxes, pairs);
    }
    Liar honest_{Liar::Lie::none};
  };
  std::vector<PeerConfig> peers;
  peers.push_back({"liar:slow", "liar", 1, "", std::make_unique<Slow>()});
  peers.push_back({"liar:quick", "liar", 1, "", std::make_unique<Liar>(Liar::Lie::none)});
  EXPECT_EQ(batch_row(std::move(peers)).peer, "liar:quick");
}

TEST(Contests, APeerOverTheLimitIsNamed) {
  Options options = tiny();
  options.limit_seconds = 1e-6;
  Report report(describe_machine());
  Progress progress;
  Ours detector(make_detector), world(make_world);
  std::vector<PeerConfig> peers = one_peer(Liar::Lie::none);
  BatchContest({"batch", options, detector, peers, report, progress}).run("D", 2500);
  FrameContest({"frames", options, world, peers, report, progress}).run("D:brown", 2500);
  ASSERT_EQ(report.rows().size(), 2u);
  for (const Row& row : report.rows()) {
    EXPECT_EQ(row.peer, "liar");
    EXPECT_NE(row.skipped.find("over limit"), std::string::npos);
    EXPECT_GT(row.ours_ms, 0);
    EXPECT_FALSE(row.failed());
  }
}

TEST(Contests, APeerOnSeveralThreadsMeetsOursOnAsMany) {
  std::vector<PeerConfig> peers = one_peer(Liar::Lie::none);
  peers[0].threads = 3;
  const Row row = batch_row(std::move(peers));
  EXPECT_EQ(row.threads, 3u);
  EXPECT_EQ(row.clock, "wall");
  EXPECT_EQ(row.pairs_equal, true);
}

}  // namespace
}  // namespace boxstream::bench
