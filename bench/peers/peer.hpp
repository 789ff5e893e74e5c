// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>
#include <boxstream/span.hpp>

namespace boxstream::bench {

/// A method of finding the pairs of a batch, and of the frames that follow it. What is timed is `find_pairs` and
/// `next_frame`, from the array of boxes to the vector of pairs; `prepare` and `release` are not. Buffers may stay warm
/// throughout.
class Peer {
 public:
  virtual ~Peer() = default;

  /// Makes what the application would own anyway, such as FCL's collision objects.
  virtual void prepare(Span<const Aabb>) {}

  /// All pairs of closed boxes that touch, each once, the smaller index in `a`; what `pairs` held is gone. Starts from
  /// nothing each time, however often it is called between `prepare` and `release`.
  virtual void find_pairs(Span<const Aabb> boxes, std::vector<Pair>& pairs) = 0;

  /// The same boxes a frame after the last call: `moved` lists those that the application set again, changed or not.
  /// `pairs` is as the last call left it. Without an own implementation: from nothing.
  virtual void next_frame(Span<const Aabb> boxes, Span<const std::uint32_t> moved, std::vector<Pair>& pairs);

  /// Pairs that the last call held before those of boxes that do not touch were left out; 0: there was no such step.
  virtual std::size_t candidates() const { return 0; }

  /// Tears down what the last calls built.
  virtual void release() {}
};

/// A peer in one configuration.
struct PeerConfig {
  std::string name;              ///< unique: "cgal:300"
  std::string family;            ///< configurations of one family compete, and the best of them is reported: "cgal"
  unsigned threads = 1;          ///< with more than one it is compared with ours on as many, by elapsed time
  std::string known_difference;  ///< why its pairs may differ from ours, if that is known; else empty
  std::unique_ptr<Peer> peer;
  std::string crashes_at = {};  ///< the motion of boxes at which its `next_frame` crashes, by a mistake of its library
};

/// Every peer that was built in, in the order in which tables show them. `threads` is what the parallel ones use.
std::vector<PeerConfig> make_peers(unsigned threads);

/// Those of `peers` whose family is in `wanted`; all if that is empty. Throws std::invalid_argument with the known
/// families for an unknown one.
std::vector<PeerConfig> choose_peers(std::vector<PeerConfig> peers, const std::vector<std::string>& wanted);

/// Those of one kind, for suites that want no others.
std::vector<PeerConfig> make_cgal_peers();
std::vector<PeerConfig> make_cgal_parallel_peers(unsigned threads);
std::vector<PeerConfig> make_bullet_peers();  // none without Bullet
std::vector<PeerConfig> make_fcl_peers();
std::vector<PeerConfig> make_embree_peers();
std::vector<PeerConfig> make_paper_peers();
std::vector<PeerConfig> make_hybrid_peers();
std::vector<PeerConfig> make_plain_peers();

}  // namespace boxstream::bench
