// SPDX-License-Identifier: MIT
#include "cache_mirror.hpp"

#include <algorithm>
#include <iterator>

#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {
namespace {

using Names = CacheMirror::Names;

struct PairsOfCache {
  const btBroadphasePair* pairs;
  std::size_t count;

  explicit PairsOfCache(btOverlappingPairCache& cache)
      : pairs(nullptr), count(std::size_t(cache.getNumOverlappingPairs())) {
    if (count != 0) pairs = cache.getOverlappingPairArrayPtr();  // an empty array has no address to ask for
  }
  Names operator[](std::size_t i) const { return {pairs[i].m_pProxy0, pairs[i].m_pProxy1}; }
};

bool comes_before(const Names& x, const Names& y) {
  return pair_key(*x.first, *x.second) < pair_key(*y.first, *y.second);
}

/// Takes out of both what they have in common.
void keep_differences(std::vector<Names>& x, std::vector<Names>& y) {
  std::sort(x.begin(), x.end(), comes_before);
  std::sort(y.begin(), y.end(), comes_before);
  std::vector<Names> only_x;
  std::set_difference(x.begin(), x.end(), y.begin(), y.end(), std::back_inserter(only_x), comes_before);
  std::vector<Names> only_y;
  std::set_difference(y.begin(), y.end(), x.begin(), x.end(), std::back_inserter(only_y), comes_before);
  x.swap(only_x);
  y.swap(only_y);
}

}  // namespace

void CacheMirror::take(btOverlappingPairCache& cache) {
  pairs_.clear();
  take_end(cache);
}

void CacheMirror::take(btOverlappingPairCache& cache, std::vector<Names>& lost, std::vector<Names>& gained) {
  lost.clear();
  gained.clear();
  const PairsOfCache now(cache);
  const std::size_t both = std::min(now.count, pairs_.size());
  for (std::size_t i = 0; i < both; ++i) {
    if (now[i] == pairs_[i]) continue;
    lost.push_back(pairs_[i]);
    gained.push_back(now[i]);
    pairs_[i] = now[i];
  }
  lost.insert(lost.end(), pairs_.begin() + std::ptrdiff_t(both), pairs_.end());
  pairs_.resize(both);
  take_end(cache);
  gained.insert(gained.end(), pairs_.begin() + std::ptrdiff_t(both), pairs_.end());
  if (!lost.empty() || !gained.empty()) keep_differences(lost, gained);
}

void CacheMirror::take_end(btOverlappingPairCache& cache) {
  const PairsOfCache now(cache);
  for (std::size_t i = pairs_.size(); i < now.count; ++i) pairs_.push_back(now[i]);
}

/// In the order in which Bullet's hashed cache does it.
void CacheMirror::remove_all_of(const btBroadphaseProxy& proxy) {
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
