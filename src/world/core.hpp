// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <boxstream/world.hpp>

#include "search/in_use.hpp"
#include "world/index.hpp"
#include "world/pairs.hpp"
#include "world/proxies.hpp"
#include "world/search.hpp"

namespace boxstream::detail {

/// What a BasicWorld is made of. The public class forwards to it; the contracts are there.
/// Each group of members has its own file: proxies, update, pairs, query, validate.
template <class S>
class WorldCore {
 public:
  using Box = BasicAabb<S>;
  using Proxies = ProxyTable<S>;

  /// `mode` forces one way of searching, for tests that compare them.
  explicit WorldCore(WorldOptions options = {}, SearchMode mode = SearchMode::cheapest);

  ProxyId create(const Box& box, Filter filter = {}, std::uint64_t user = 0);
  void create(Span<const Box> boxes, Span<const Filter> filters, Span<ProxyId> out, Span<const std::uint64_t> users);
  bool destroy(ProxyId id);
  std::size_t destroy(Span<const ProxyId> ids);
  void clear();
  bool move(ProxyId id, const Box& box);
  std::size_t move(Span<const ProxyId> ids, Span<const Box> boxes);
  bool set_filter(ProxyId id, Filter filter);
  bool ask_again(ProxyId id);
  void ask_again();
  bool set_user(ProxyId id, std::uint64_t user);
  bool contains(ProxyId id) const { return proxies_.rank(id) != Proxies::none; }
  std::size_t size() const { return proxies_.live(); }
  Box box(ProxyId id) const;
  Filter filter(ProxyId id) const;
  std::uint64_t user(ProxyId id) const;

  WorldStats update();
  WorldStats update(ProxyPairFilter accept);
  void limit_begun(std::uint64_t most) {
    const InUse::Change change(in_use_);
    most_begun_ = most;
  }
  Span<const ProxyPair> begun() const { return begun_; }
  Span<const ProxyPair> ended() const { return ended_; }

  std::uint64_t pair_count() const { return pairs_.size(); }
  void for_each_pair(FunctionRef<bool(ProxyPair)> visit) const;
  void stream_pairs(ProxyPairSink sink) const;
  void begin_pairs_of(ProxyId id, ProxyPairFilter accept, FunctionRef<void(ProxyPair)> begin,
                      bool accept_alone = false);
  bool release(ProxyId a, ProxyId b);

  void query_box(const Box& box, ProxyVisitor visit) const;
  void query_planes(Span<const BasicPlane<S>> planes, ProxyVisitor visit) const;
  void query_ray(const BasicRay<S>& ray, RayVisitor<S> visit) const;
  std::size_t query_nearest(const S (&point)[3], Span<ProxyId> out) const;
  void query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const;
  void nearest_pairs(const WorldCore& other, S limit, NearPairVisitor<S> visit) const;
  Box bounds() const;

  void validate() const;

 private:
  ProxyPair named(PairKey key) const { return {proxies_.id(first_of(key)), proxies_.id(second_of(key))}; }
  bool is_touched(PairKey key) const {
    return proxies_.is_touched(first_of(key)) || proxies_.is_touched(second_of(key));
  }
  bool is_nearer(const S (&point)[3], std::uint32_t a, std::uint32_t b) const;
  ProxyId id_of_slot(std::uint32_t slot) const { return proxies_.id(proxies_.rank_of_slot(slot)); }
  void make_room(std::size_t more);
  void drop_tombstones();

  WorldStats update_with(const ProxyPairFilter* accept);
  void compare_found(SearchMode mode, const ProxyPairFilter* accept, Stats& stats);
  bool compare_fences(const ProxyPairFilter* accept);
  void sort_found();
  void leave_out_refused(std::size_t first);
  void check_begun(std::size_t count) const {
    if (count > most_begun_) throw std::length_error("boxstream: more pairs begin than the limit that was set");
  }
  void confirm_doubtful();
  void ask(ProxyPairFilter accept);
  void find_ended();
  void name(const std::vector<PairKey>& keys, std::vector<ProxyPair>& pairs) const;

  InUse in_use_;
  WorldOptions options_;
  SearchMode forced_mode_;
  std::uint64_t most_begun_ = ~std::uint64_t{0};
  Proxies proxies_;
  HeldPairs pairs_;
  LazyIndex<S> index_;
  OverlapSearch<S> search_;
  PairSorter sorter_;
  std::vector<ProxyPair> begun_;
  std::vector<ProxyPair> ended_;

  // Scratch, kept for its memory.
  std::vector<Pair> fresh_;     // found and not held, as they come
  std::vector<PairKey> found_;  // the same, in order
  std::vector<PairKey> gone_;
  std::vector<Pair> ended_pairs_;  // as they come
  std::vector<PairKey> refused_;   // of the found ones
  std::vector<PairKey> kept_;      // held although filters refuse them
  BatchWalk<S> walk_;
  std::vector<ProxyPair> next_begun_;
  std::vector<ProxyPair> next_ended_;
  std::vector<std::uint8_t> is_referenced_;
};

}  // namespace boxstream::detail
