// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// A method of finding the pairs between two batches, from the arrays of boxes to the vector of pairs: all pairs of
/// closed boxes that touch, a box of the first set in `a`; clears `pairs` first. Buffers may stay warm.
using CrossSearch = std::function<void(Span<const Aabb> a, Span<const Aabb> b, std::vector<Pair>& pairs)>;

/// A peer in one configuration; those of one family compete, and the best of them is reported.
struct CrossPeerConfig {
  std::string name;
  std::string family;
  CrossSearch find_pairs;
};

/// Every peer that was built in, in the order in which tables show them.
std::vector<CrossPeerConfig> make_cross_peers();

/// Each of the smaller set against blocks of 512 of the larger one, put into columns.
CrossSearch make_block_loop();
/// A plain tree over each set, walked together; or over the smaller one, queried with each box of the larger.
CrossSearch make_two_trees();
CrossSearch make_tree_over_the_few();
CrossSearch make_cgal_cross(std::size_t cutoff);
CrossSearch make_embree_cross();

}  // namespace boxstream::bench
