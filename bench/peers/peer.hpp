// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// Another way to find the pairs of a batch. What is timed is `find_pairs`, from the array of boxes to the vector of
/// pairs; buffers may stay warm between calls, as ours do.
class Peer {
 public:
  virtual ~Peer() = default;

  /// All pairs of closed boxes that touch, each once, the smaller index in `a`. `pairs` is cleared first.
  virtual void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) = 0;
};

/// A peer in one configuration.
struct PeerConfig {
  std::string name;       ///< unique: "cgal:300"
  std::string family;     ///< configurations of one family compete, and the best of them is reported: "cgal"
  std::size_t largest_n;  ///< beyond this it is not even tried
  std::unique_ptr<Peer> peer;
};

std::vector<PeerConfig> make_peers();

std::unique_ptr<Peer> make_brute_force();
std::unique_ptr<Peer> make_sweep();
/// Present only where CGAL was found (BOXSTREAM_BENCH_CGAL).
std::unique_ptr<Peer> make_cgal(std::size_t cutoff);

}  // namespace boxstream::bench
