// SPDX-License-Identifier: MIT
#include <limits>

#include "peers/peer.hpp"

namespace boxstream::bench {

std::vector<PeerConfig> make_peers() {
  constexpr std::size_t any = std::numeric_limits<std::size_t>::max();
  std::vector<PeerConfig> peers;
#ifdef BOXSTREAM_BENCH_CGAL
  for (const std::size_t cutoff : {10, 100, 300, 1000})
    peers.push_back({"cgal:" + std::to_string(cutoff), "cgal", any, make_cgal(cutoff)});
#endif
  peers.push_back({"sweep", "sweep", any, make_sweep()});
  peers.push_back({"brute", "brute", 3000, make_brute_force()});
  return peers;
}

}  // namespace boxstream::bench
