// SPDX-License-Identifier: MIT
#include "peers/plain.hpp"

#include "peers/peer.hpp"

namespace boxstream::bench {

std::vector<PeerConfig> make_plain_peers() {
  std::vector<PeerConfig> peers;
  peers.push_back({"sweep", "sweep", 1, "", make_sweep()});
  peers.push_back({"tree", "tree", 1, "", make_plain_tree()});
  peers.push_back({"bare-loop", "bare-loop", 1, "", make_bare_loop()});
  peers.push_back({"sorted-sweep", "sorted-sweep", 1, "", make_sorted_sweep()});
  peers.push_back({"brute", "brute", 1, "", make_brute_force()});
  return peers;
}

}  // namespace boxstream::bench
