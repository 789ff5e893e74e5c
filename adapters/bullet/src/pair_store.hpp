// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include "pair_links.hpp"
#include "precision.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// A pair beside its key, for sorting and merging.
struct KeyedPair {
  std::uint64_t key;
  btBroadphasePair pair;

  KeyedPair(Proxy& a, Proxy& b) : key(pair_key(a, b)), pair(a, b) {}
  KeyedPair(std::uint64_t k, const btBroadphasePair& p) : key(k), pair(p) {}
  friend bool operator<(const KeyedPair& x, const KeyedPair& y) { return x.key < y.key; }
};

/// The dense array of pairs that Bullet reads, in key order after each batch, and the keys beside it.
///
/// Between batches single pairs come and go at constant cost: new ones at the end, and the last one fills the place of
/// one removed. What that put out of order is remembered, so that order comes back by sorting just those.
/// It stores; it calls no callbacks and frees no algorithms. Looking for an absent pair, or for one after a removal,
/// may take one pass over all pairs once per batch.
class PairStore {
 public:
  static constexpr std::uint32_t npos = ~std::uint32_t{0};

  btBroadphasePairArray& array() { return pairs_; }
  std::uint32_t size() const { return std::uint32_t(pairs_.size()); }
  btBroadphasePair& operator[](std::uint32_t index) { return pairs_[int(index)]; }
  std::uint64_t key(std::uint32_t index) const { return keys_[index]; }

  /// Where the pair is; npos if it is not held. The proxies must be in order of their ids.
  std::uint32_t find(const Proxy& low, const Proxy& high);
  /// Any one pair of the proxy; npos if it has none.
  std::uint32_t any_of(const Proxy& proxy);
  /// Calls `visit(index)` for each pair of `proxy`; it must not add or remove pairs.
  template <class F>
  void for_each_of(const Proxy& proxy, F&& visit);

  /// Adds a pair that is not held and returns its index.
  std::uint32_t add(const KeyedPair& added);
  /// Removes the pair at `index`; the last pair moves there.
  void remove(std::uint32_t index);

  /// Puts all pairs in key order.
  void restore_order();
  /// Removes the pairs with the keys of `gone`, appending those that were held to `removed`, and adds pairs that are
  /// not held. Both are ascending and have nothing in common. Order must have been restored.
  template <class Keyed>
  void exchange(const std::vector<Keyed>& gone, const std::vector<KeyedPair>& added, std::vector<KeyedPair>& removed);
  /// True if a pair with this key is held. Order must have been restored.
  bool contains_sorted(std::uint64_t key) const;

  const std::vector<std::uint64_t>& keys() const { return keys_; }
  void validate() const;

 private:
  /// Removes the pairs at these indices, appending them to `removed`, and puts the added pairs where they belong among
  /// those that remain, which are in order if anything is added. Each pair moves at most once.
  void splice(const std::vector<std::uint32_t>& gone, const std::vector<KeyedPair>& added,
              std::vector<KeyedPair>& removed);
  void move_runs();
  void grow_to(std::uint64_t new_size);
  void link();

  btBroadphasePairArray pairs_;
  std::vector<std::uint64_t> keys_;
  std::uint32_t in_order_ = 0;            ///< the first so many are in key order, but for those in displaced_
  std::vector<std::uint32_t> displaced_;  ///< indices below in_order_ (or gone), repeats possible
  std::vector<KeyedPair> loose_;          ///< scratch of restore_order
  std::vector<std::uint32_t> found_;      ///< scratch of exchange
  struct Run {
    std::uint32_t begin, end;
    std::int64_t shift;
  };
  std::vector<Run> runs_;  ///< scratch of splice, as is the next
  std::vector<std::uint32_t> arrivals_;
  PairLinks links_;
};

inline std::uint64_t key_of(std::uint64_t key) {
  return key;
}
inline std::uint64_t key_of(const KeyedPair& pair) {
  return pair.key;
}

template <class Keyed>
void PairStore::exchange(const std::vector<Keyed>& gone, const std::vector<KeyedPair>& added,
                         std::vector<KeyedPair>& removed) {
  found_.clear();
  auto place = keys_.cbegin();
  for (const Keyed& wanted : gone) {
    place = std::lower_bound(place, keys_.cend(), key_of(wanted));
    if (place == keys_.cend()) break;
    if (*place == key_of(wanted)) found_.push_back(std::uint32_t(place++ - keys_.cbegin()));
  }
  splice(found_, added, removed);
}

template <class F>
void PairStore::for_each_of(const Proxy& proxy, F&& visit) {
  link();
  for (std::uint32_t node = links_.first(proxy); node != no_link;) {
    const std::uint32_t next = links_.next(node);
    visit(node / 2);
    node = next;
  }
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
