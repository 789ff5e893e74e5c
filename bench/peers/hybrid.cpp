// SPDX-License-Identifier: MIT
#include <memory>

#include <boxstream/detector.hpp>

#include "peers/peer.hpp"

namespace boxstream::bench {

namespace {

/// Our own library by the paper's tree alone; each frame anew.
class HybridPeer final : public Peer {
 public:
  void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) override { detector_.find_pairs(boxes, pairs); }

 private:
  static DetectorOptions options() {
    DetectorOptions options;
    options.method = Method::hybrid;
    return options;
  }

  Detector detector_{options()};
};

}  // namespace

std::vector<PeerConfig> make_hybrid_peers() {
  std::vector<PeerConfig> peers;
  peers.push_back({"hybrid", "hybrid", 1, "", std::make_unique<HybridPeer>()});
  return peers;
}

}  // namespace boxstream::bench
