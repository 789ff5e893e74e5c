// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// A way to find the pairs between two batches, from the arrays of boxes to the vector of pairs. Buffers may stay warm.
class CrossPeer {
 public:
  virtual ~CrossPeer() = default;

  /// All pairs of closed boxes that touch, a box of the first set in `a`; what `pairs` held is gone.
  virtual void find_pairs(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs) = 0;
};

/// A peer in one configuration; those of one family compete, and the best of them is reported.
struct CrossPeerConfig {
  std::string name;
  std::string family;
  std::unique_ptr<CrossPeer> peer;
};

/// Every peer that was built in, in the order in which tables show them.
std::vector<CrossPeerConfig> make_cross_peers();

/// Each of the smaller set against blocks of 512 of the larger one, put into columns.
std::unique_ptr<CrossPeer> make_block_loop();
/// A plain tree over each set, walked together; or over the smaller one, asked for each box of the larger.
std::unique_ptr<CrossPeer> make_two_trees();
std::unique_ptr<CrossPeer> make_tree_over_the_few();
std::unique_ptr<CrossPeer> make_cgal_cross(std::size_t cutoff);
std::unique_ptr<CrossPeer> make_embree_cross();

}  // namespace boxstream::bench
