// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/span.hpp>

#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// For each proxy a doubly linked list of its pairs in an array. Built in one pass when first needed, then kept up to
/// date at constant cost per added, removed or moved pair, until drop() makes all lists invalid at once.
/// A link is 2 * index of the pair + side of the proxy in it.
class PairLinks {
 public:
  bool built() const { return built_; }
  /// Nothing if they are. Lists begin with the last pairs: of the array, or of `order`, if that has indices of pairs
  /// (or `no_link`, which is left out).
  void build(btBroadphasePairArray& pairs, Span<const std::uint32_t> order = {});
  void drop() { built_ = false; }
  void give_back() {
    drop();
    std::vector<Node>().swap(nodes_);
  }

  // Only while built; `index` is that of the pair in the array.
  void add(const btBroadphasePair& pair, std::uint32_t index);
  void remove(const btBroadphasePair& pair, std::uint32_t index);
  /// `pair` is at `from`, its last place, and about to be at `to`, which is free.
  void move(const btBroadphasePair& pair, std::uint32_t from, std::uint32_t to);

  std::uint32_t first(const Proxy& proxy) const { return has_list(proxy) ? proxy.first_link : no_link; }
  std::uint32_t next(std::uint32_t link) const { return nodes_[link].next; }
  std::uint32_t degree(const Proxy& proxy) const { return has_list(proxy) ? proxy.degree : 0; }
  void validate(const btBroadphasePairArray& pairs) const;

 private:
  struct Node {
    std::uint32_t previous;
    std::uint32_t next;
  };

  bool has_list(const Proxy& proxy) const { return proxy.links_epoch == epoch_; }
  void push(Proxy& proxy, std::uint32_t link);
  void cut(Proxy& proxy, std::uint32_t link);

  std::vector<Node> nodes_;
  std::uint32_t epoch_ = 0;
  bool built_ = false;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
