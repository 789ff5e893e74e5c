// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/bullet/precision.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// A copy of the pairs of a borrowed cache, in its order, by which changes made by users are found. 16 bytes a pair.
///
/// A comparison is one pass over two arrays. Added and removed pairs are then among the elements that differ: a few,
/// because caches add at the end and fill gaps with their last pair. For other caches it takes a sort.
class CacheSnapshot {
 public:
  struct Entry {
    btBroadphaseProxy* first;
    btBroadphaseProxy* second;
    friend bool operator==(const Entry& x, const Entry& y) { return x.first == y.first && x.second == y.second; }
  };

  std::size_t size() const { return pairs_.size(); }

  /// Copies the pairs of the cache.
  void capture(btOverlappingPairCache& cache);

  /// The same; `lost` and `gained` get the pairs that were removed and added, both sorted by unique ids.
  void capture(btOverlappingPairCache& cache, std::vector<Entry>& lost, std::vector<Entry>& gained);

  /// Copies pairs that were added at the end of the cache.
  void add_new(btOverlappingPairCache& cache);

  /// Follows a removal of all pairs of a proxy.
  void remove_all_of(const btBroadphaseProxy& proxy);

 private:
  std::vector<Entry> pairs_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
