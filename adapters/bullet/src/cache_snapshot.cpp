// SPDX-License-Identifier: MIT
#include "cache_snapshot.hpp"

#include <algorithm>
#include <iterator>

#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

using Entry = CacheSnapshot::Entry;

struct CachePairs {
  const btBroadphasePair* pairs;
  std::size_t count;

  explicit CachePairs(btOverlappingPairCache& cache)
      : pairs(nullptr), count(std::size_t(cache.getNumOverlappingPairs())) {
    if (count != 0) pairs = cache.getOverlappingPairArrayPtr();  // an empty array has no address
  }
  Entry operator[](std::size_t i) const { return {pairs[i].m_pProxy0, pairs[i].m_pProxy1}; }
};

bool precedes(const Entry& x, const Entry& y) {
  return pair_key(*x.first, *x.second) < pair_key(*y.first, *y.second);
}

/// Removes common elements from both.
void keep_differences(std::vector<Entry>& x, std::vector<Entry>& y) {
  std::sort(x.begin(), x.end(), precedes);
  std::sort(y.begin(), y.end(), precedes);
  std::vector<Entry> only_x;
  std::set_difference(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(only_x), precedes);
  std::vector<Entry> only_y;
  std::set_difference(y.begin(), y.end(), x.begin(), x.end(), std::back_inserter(only_y), precedes);
  x.swap(only_x);
  y.swap(only_y);
}

}  // namespace

void CacheSnapshot::capture(btOverlappingPairCache& cache) {
  pairs_.clear();
  add_new(cache);
}

void CacheSnapshot::capture(btOverlappingPairCache& cache, std::vector<Entry>& lost, std::vector<Entry>& gained) {
  lost.clear();
  gained.clear();
  const CachePairs now(cache);
  const std::size_t both = std::min(now.count, pairs_.size());
  for (std::size_t i = 0; i < both; ++i) {
    if (now[i] == pairs_[i]) continue;
    lost.push_back(pairs_[i]);
    gained.push_back(now[i]);
    pairs_[i] = now[i];
  }
  lost.insert(lost.end(), pairs_.begin() + std::ptrdiff_t(both), pairs_.end());
  pairs_.resize(both);
  add_new(cache);
  gained.insert(gained.end(), pairs_.begin() + std::ptrdiff_t(both), pairs_.end());
  if (!lost.empty() || !gained.empty()) keep_differences(lost, gained);
}

void CacheSnapshot::add_new(btOverlappingPairCache& cache) {
  const CachePairs now(cache);
  for (std::size_t i = pairs_.size(); i < now.count; ++i) pairs_.push_back(now[i]);
}

/// In the order of Bullet's hashed cache.
void CacheSnapshot::remove_all_of(const btBroadphaseProxy& proxy) {
  for (std::size_t i = 0; i < pairs_.size();) {
    if (pairs_[i].first != &proxy && pairs_[i].second != &proxy) {
      ++i;
      continue;
    }
    pairs_[i] = pairs_.back();
    pairs_.pop_back();
  }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
