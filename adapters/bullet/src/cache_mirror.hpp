// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include "precision.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// What a borrowed cache held when it was last seen, place for place, so that what users did to it shows. 16 bytes a
/// pair.
///
/// A comparison is one pass over two arrays. What a user added or removed is then found among the places that differ:
/// a few, because caches add at the end and fill gaps with their last pair. A cache that does otherwise costs a sort.
class CacheMirror {
 public:
  struct Names {
    btBroadphaseProxy* first;
    btBroadphaseProxy* second;
    friend bool operator==(const Names& x, const Names& y) { return x.first == y.first && x.second == y.second; }
  };

  std::size_t size() const { return pairs_.size(); }

  /// Holds what the cache holds now.
  void take(btOverlappingPairCache& cache);

  /// The same, and fills in which pairs are there no more, and which are new; both in order of unique ids.
  void take(btOverlappingPairCache& cache, std::vector<Names>& lost, std::vector<Names>& gained);

  /// The broad-phase has added pairs to the cache, which are at its end.
  void take_end(btOverlappingPairCache& cache);

  /// The cache removes all pairs of this proxy.
  void remove_all_of(const btBroadphaseProxy& proxy);

 private:
  std::vector<Names> pairs_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
