// SPDX-License-Identifier: MIT
#include <string>

#include "papers/hybrid/ranks.hpp"
#include "papers/hybrid/versions.hpp"
#include "peers/peer.hpp"

namespace boxstream::bench {

namespace {

/// The paper's own program. It wants integers, and gets the ranks of all ends before the clock starts.
class VersionTwoPeer final : public Peer {
 public:
  explicit VersionTwoPeer(std::size_t cutoff) { options_.cutoffs = papers::Cutoffs(cutoff); }

  void prepare(Span<const Aabb> boxes) override { ranks_ = papers::ranks(boxes); }

  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override {
    pairs.clear();
    if (boxes.empty()) return;
    papers::VersionTwo search(ranks_);
    search.find_pairs(options_, [&](std::uint32_t i, std::uint32_t j) {
      pairs.push_back(i < j ? Pair{i, j} : Pair{j, i});
    });
  }

  void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t>, std::vector<Pair>& pairs) override {
    prepare(boxes);
    find_pairs(boxes, pairs);
  }

 private:
  papers::HybridOptions options_;
  std::vector<papers::Box> ranks_;
};

}  // namespace

std::vector<PeerConfig> make_paper_peers() {
  std::vector<PeerConfig> peers;
  for (const std::size_t cutoff : {30, 2000})
    peers.push_back(
        {"version-two:" + std::to_string(cutoff), "version-two", 1, "", std::make_unique<VersionTwoPeer>(cutoff)});
  return peers;
}

}  // namespace boxstream::bench
