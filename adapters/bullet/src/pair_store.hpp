// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/world.hpp>

#include "late_splice.hpp"
#include "pair_links.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// The order of the World: by creation of the older proxy, then of the younger one.
bool comes_before(const btBroadphasePair& x, const btBroadphasePair& y);

/// The dense array of pairs that Bullet reads; after each batch those that the World holds, in its order.
///
/// Between batches single pairs are added and removed at constant cost: new ones at the end, and the last pair fills
/// the gap of a removed one. Such moves are recorded and undone before the next batch, because the World reports
/// changes by places. The store calls no callbacks and frees no algorithms. The pairs of a proxy are found from the
/// back of the order of before: by a pass over all, and for a second proxy since the last batch by links, which take
/// longer to build.
///
///     settled    [ pairs of the World, in its order ]             take_out, put_in: as it will be told
///        | add, remove
///     edited     [ those, gaps filled from the back ][ added ]     removals_: the moves, to be undone
///        | restore_order, where something asks for it
///     sorted     [ all, by creation ]                              order_: where each was
///        | prepare: undo moves, drop what the World has released
///     prepared   [ pairs of the World, in its order ][ others ]
///        | World::update, then follow: its changes are spliced in, others that it holds now get their places
///     settled
///
/// Where a batch changes little of what is settled, the array is spliced when it is read next: by a pass over it as the
/// pass goes, and at once by all else. A program that has a reference to the array itself may read it at any time, so
/// that it is spliced in the batch from then on.
class PairStore {
 public:
  using World = BasicWorld<btScalar>;

  static constexpr std::uint32_t npos = ~std::uint32_t{0};

  std::uint32_t size() const { return is_late() ? world_pairs_ : std::uint32_t(pairs_.size()); }
  btBroadphasePair& operator[](std::uint32_t index) {
    if (index >= in_place_.load(std::memory_order_relaxed)) splice_until(index + 1);
    return pairs_[int(index)];
  }
  /// Null if there are none. From several threads at once.
  btBroadphasePair* all() {
    splice_late();
    return size() == 0 ? nullptr : &pairs_[0];
  }
  /// For as long as the store lives.
  btBroadphasePairArray& lend() {
    is_lent_ = true;
    splice_late();
    return pairs_;
  }

  /// Where the pair is; npos if it is not held.
  std::uint32_t find(const Proxy& a, const Proxy& b);
  /// Any one pair of the proxy; npos if it has none.
  std::uint32_t any_of(const Proxy& proxy);
  /// Calls `visit(index)` for each pair of `proxy`; it must not add or remove pairs.
  template <class F>
  void for_each_of(const Proxy& proxy, F&& visit);

  /// Adds a pair that is not held and returns its index.
  std::uint32_t add(const btBroadphasePair& added);
  /// Removes the pair at `index`; the last pair moves there.
  void remove(std::uint32_t index);

  /// Puts all pairs in the order in which their proxies were created.
  void restore_order();

  /// Before an update: puts the pairs that the World holds in its order, and others behind them. The pairs that
  /// were removed since the last batch must have been released.
  void prepare(const World& world);

  /// After an update: applies its changes. Appends to `ended` the pairs that ended, and old pairs that the World does
  /// not hold; to `begun` the pairs that began and were not there. For pairs of a destroyed proxy `left_out(pair)` is
  /// called instead.
  template <class LeftOut>
  void follow(const World& world, std::vector<btBroadphasePair>& ended, std::vector<btBroadphasePair>& begun,
              LeftOut&& left_out);

  // Of pairs that the World is told of later, while settled.

  /// Appends the pairs for which `is(pair)` is true to `taken`.
  template <class Is>
  void take_out(Is&& is, std::vector<btBroadphasePair>& taken);
  /// In any order, which changes.
  void put_in(std::vector<btBroadphasePair>& begun);
  /// Settled or not before: from now on the World holds these pairs.
  void settle();

  /// Gives memory back that many pairs took, after some batches with fewer.
  void give_back_unused();
  /// The same now, whatever lies idle.
  void shrink_to_fit() { give_back(0); }
  /// True if all pairs are those of the World, or those that it will be told of, in its order.
  bool is_settled() const { return is_in_world_order() && size() == world_pairs_; }
  /// Number of pairs at the front that are those of the World, in its order.
  std::uint32_t in_order() const { return is_in_world_order() ? world_pairs_ : 0; }

  /// The World has been cleared, and no proxy is left. Gives all memory back.
  void clear();

  void validate();

 private:
  /// The last of `last` + 1 pairs filled the place of another.
  struct Removal {
    std::uint32_t index, last;
  };

  void give_back(std::size_t spare);
  bool is_in_world_order() const { return removals_.empty() && !is_sorted_; }
  bool is_late() const { return in_place_.load(std::memory_order_acquire) != npos; }
  bool follow_late(const World& world, std::vector<btBroadphasePair>& ended, std::vector<btBroadphasePair>& begun);
  void splice_late() {
    if (is_late()) splice_all();
  }
  void splice_all();
  void splice_until(std::uint32_t end);
  /// The pairs of the proxy are listed in `scanned_`, unless links are built, or have been now.
  bool scan(const Proxy& proxy);
  void build_links();
  void forget_places();
  void find_holes();
  void undo_moves();
  std::size_t take_others();
  void splice(const Splice& changes);
  void grow_to(std::uint64_t new_size);

  btBroadphasePairArray pairs_;
  LateSplice late_;
  std::atomic<std::uint32_t> in_place_{npos};  ///< so many are, until a late splice is made; npos if there is none
  std::mutex splicing_;
  bool is_lent_ = false;
  std::uint32_t world_pairs_ = 0;      ///< pairs of the World after the last update; they come first
  std::uint32_t prepared_ = 0;         ///< number of pairs before the last update
  std::vector<Removal> removals_;      ///< since the last update, or since order was restored
  bool is_sorted_ = false;             ///< order was restored
  std::vector<std::uint32_t> order_;   ///< where pairs were before
  std::uint32_t size_with_holes_ = 0;  ///< at that time

  std::vector<btBroadphasePair> others_;  ///< scratch, as the rest: pairs behind those of the World
  std::vector<std::uint32_t> gone_, arrived_;
  bool has_many_holes_ = false;
  PairLinks links_;

  // Before links pay: the pairs of the last proxy that was asked for, ascending.
  const Proxy* scanned_for_ = nullptr;
  std::vector<std::uint32_t> scanned_;

  unsigned batches_with_less_ = 0;  ///< in a row, in which memory lay idle
};

template <class F>
void PairStore::for_each_of(const Proxy& proxy, F&& visit) {
  splice_late();
  if (scan(proxy)) {  // from the back, as lists go
    for (std::size_t i = scanned_.size(); i-- > 0;) visit(scanned_[i]);
    return;
  }
  for (std::uint32_t node = links_.first(proxy); node != no_link;) {
    const std::uint32_t next = links_.next(node);
    visit(node / 2);
    node = next;
  }
}

template <class Is>
void PairStore::take_out(Is&& is, std::vector<btBroadphasePair>& taken) {
  splice_late();
  forget_places();
  int kept = 0;
  for (int i = 0; i < pairs_.size(); ++i)
    if (is(pairs_[i]))
      taken.push_back(pairs_[i]);
    else
      pairs_[kept++] = pairs_[i];
  pairs_.resizeNoInitialize(kept);
  world_pairs_ = size();
}

template <class LeftOut>
void PairStore::follow(const World& world, std::vector<btBroadphasePair>& ended, std::vector<btBroadphasePair>& begun,
                       LeftOut&& left_out) {
  const Splice changes = world.changes();
  bool has_holes = !removals_.empty();
  undo_moves();
  if (!has_holes && size() == world_pairs_ && (changes.empty() || follow_late(world, ended, begun))) return;
  splice_late();
  const std::size_t old_others = take_others();
  for (const std::uint32_t place : changes.removed)
    if (pairs_[int(place)].m_pProxy0) ended.push_back(pairs_[int(place)]);
  splice(changes);
  for (std::size_t i = 0; i < others_.size(); ++i)
    if (const auto place = place_in(world, others_[i]))
      pairs_[int(*place)] = others_[i];
    else if (i < old_others)
      ended.push_back(others_[i]);
    else
      add(others_[i]);
  for (std::size_t i = 0; i < changes.inserted.size(); ++i) {
    btBroadphasePair& place = pairs_[int(changes.inserted[i])];
    if (place.m_pProxy0) continue;
    const btBroadphasePair pair(proxy_of(world, world.begun()[i].a), proxy_of(world, world.begun()[i].b));
    const bool stays = !has_destroyed(pair);
    has_holes |= !stays;
    if (stays)
      begun.push_back(place = pair);
    else
      left_out(pair);
  }
  for (std::uint32_t i = size(); has_holes && i-- > 0;)
    if (!pairs_[int(i)].m_pProxy0) remove(i);
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
