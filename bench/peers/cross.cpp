// SPDX-License-Identifier: MIT
#include "peers/cross.hpp"

namespace boxstream::bench {

std::vector<CrossPeerConfig> make_cross_peers() {
  std::vector<CrossPeerConfig> peers;
  peers.push_back({"block-loop", "block-loop", make_block_loop()});
  peers.push_back({"two-trees", "two-trees", make_two_trees()});
  peers.push_back({"tree-of-few", "tree-of-few", make_tree_over_the_few()});
#ifdef BOXSTREAM_BENCH_CGAL
  for (const std::size_t cutoff : {10, 100, 1000})
    peers.push_back({"cgal:" + std::to_string(cutoff), "cgal", make_cgal_cross(cutoff)});
#endif
#ifdef BOXSTREAM_BENCH_EMBREE
  peers.push_back({"embree", "embree", make_embree_cross()});
#endif
  return peers;
}

}  // namespace boxstream::bench
