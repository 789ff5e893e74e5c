// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include <boxstream/world.hpp>

#include "base/in_use.hpp"
#include "base/thresholds.hpp"
#include "world/few_rows.hpp"
#include "world/index.hpp"
#include "world/overlap_search.hpp"
#include "world/rooms.hpp"
#include "world/state/pairs.hpp"
#include "world/state/pairs_of_few.hpp"
#include "world/state/proxies.hpp"

namespace boxstream::detail {

/// What a BasicWorld is made of, and what its methods share. These have a file for each group: proxies (core), update,
/// pairs one by one, query, nearest, validate.
template <class S>
class WorldParts {
 public:
  using Box = BasicAabb<S>;
  using Proxies = ProxyTable<S>;

  WorldParts(WorldOptions options, SearchMode mode)
      : options_(options),
        forced_mode_(options.method == Method::hybrid && mode == SearchMode::cheapest ? SearchMode::all : mode),
        search_(options) {}

  void force(SearchMode mode) { forced_mode_ = mode; }
  std::size_t rooms() const { return rooms_.count(); }

 private:
  friend class BasicWorld<S>;

  /// Calls `with(rank)` if the id is live, and returns whether it is.
  template <class With>
  bool change(ProxyId id, With&& with) {
    const InUse::Change change(in_use_);
    const std::uint32_t rank = proxies_.rank(id);
    if (rank == Proxies::none) return false;
    with(rank);
    return true;
  }
  template <class Visit>
  void for_each_touching(std::uint32_t rank, Visit&& visit);
  void fit_rooms() noexcept;
  ProxyPair named(PairKey key) const { return {proxies_.id(first_of(key)), proxies_.id(second_of(key))}; }
  bool is_dirty(PairKey key) const { return proxies_.is_dirty(first_of(key)) || proxies_.is_dirty(second_of(key)); }
  ProxyId id_of_slot(std::uint32_t slot) const { return proxies_.id(proxies_.rank_of_slot(slot)); }
  /// True for a ray that is compared with few boxes one by one instead of asking the index. Boxes always are.
  bool scans_few() const {
    return proxies_.few().is_kept() &&
           (proxies_.ranks() <= thresholds.always_scanned || !index_.is_worth_asking(thresholds.scans_before_index));
  }
  void make_room(std::size_t more);
  void drop_tombstones();

  WorldStats update_with(const ProxyPairFilter* accept);
  WorldStats update_told(Span<const ProxyPair> begin, Span<const ProxyPair> end, ProxyPairFilter accept);
  void search(const ProxyPairFilter* accept, Stats& stats);
  void apply_changes(bool by_rows);
  void search_and_compare(SearchMode mode, const ProxyPairFilter* accept, Stats& stats);
  SearchMode choose();
  bool is_of_few(SearchMode mode) const;
  void compare_few(SearchMode mode, const ProxyPairFilter* accept);
  void compare_all_rows();
  void compare_dirty_rows();
  void compare_word(std::uint32_t rank, std::size_t word, std::uint64_t found, std::uint64_t held,
                    std::uint64_t looked_at);
  void change_word(std::uint32_t rank, std::size_t word, std::uint64_t found, std::uint64_t held);
  void compare_found(SearchMode mode, const ProxyPairFilter* accept, Stats& stats);
  bool merge_found(bool meets_refused);
  bool compare_candidates(const ProxyPairFilter* accept);
  void sort_found();
  void leave_out_refused(std::size_t first);
  void check_begun(std::size_t count) const {
    if (count > most_begun_) throw std::length_error("boxstream: more pairs begin than the limit that was set");
  }
  void recheck_released();
  template <class Visit>
  void for_each_released(Visit&& visit) const;
  void ask(ProxyPairFilter accept);
  void ask_early(ProxyPairFilter accept);
  void take_accepted();
  void find_ended();
  bool has_events() const { return !begun_.empty() || !ended_.empty(); }
  void forget_changes() noexcept;
  void give_back_unused(std::size_t used) noexcept;
  void drop_scratch() noexcept;
  void name(const std::vector<PairKey>& keys, std::vector<ProxyPair>& pairs) const;

  InUse in_use_;
  WorldOptions options_;
  SearchMode forced_mode_;
  std::uint64_t most_begun_ = ~std::uint64_t{0};
  Proxies proxies_;
  HeldPairs pairs_;
  FewRows rows_;  // of the same pairs, while there are few proxies
  LazyIndex<S> index_;
  OverlapSearch<S> search_;
  Rooms<S> rooms_;
  PairSorter sorter_;
  std::vector<ProxyPair> begun_;
  std::vector<ProxyPair> ended_;
  std::vector<std::uint32_t> begun_places_;
  std::vector<std::uint32_t> ended_places_;

  // Scratch, kept for its memory.
  std::vector<Pair> all_found_;  // where the next lists are made of them
  bool is_merged_ = false;       // these are made, and need not be exchanged
  bool is_of_few_ = false;       // see is_of_few
  PairsOfFew pairs_of_few_;
  std::vector<Pair> fresh_;     // found and not held, as they come
  std::vector<PairKey> found_;  // the same, in order
  std::vector<PairKey> gone_;
  std::vector<Pair> ended_pairs_;  // as they come
  std::vector<Pair> accepted_;     // of those that were asked about before all were found
  std::vector<PairKey> refused_;   // of the found ones, if candidates are kept
  bool keeps_refused_ = false;
  bool holds_much_ = false;         // more than a little, for scratch or for pairs that are gone
  unsigned updates_with_less_ = 0;  // in a row, in which memory lay idle
  std::vector<PairKey> kept_;       // held although filters refuse them
  std::vector<ProxyPair> next_begun_;
  std::vector<ProxyPair> next_ended_;
  std::vector<std::uint32_t> next_begun_places_;
  std::vector<std::uint32_t> next_ended_places_;
  std::vector<std::uint8_t> is_referenced_;
};

/// Released pairs that have not changed since look like refused ones. They are visited if they overlap and the filters
/// accept them, held or not.
template <class S>
template <class Visit>
void WorldParts<S>::for_each_released(Visit&& visit) const {
  for (const PairKey key : pairs_.recheck()) {
    const Pair pair{first_of(key), second_of(key)};
    if (is_dirty(key)) continue;
    if (proxies_.touching(pair.a, pair.b) && accepts(proxies_.filter(pair.a), proxies_.filter(pair.b))) visit(pair);
  }
}

}  // namespace boxstream::detail

namespace boxstream {

template <class S>
struct BasicWorld<S>::Impl : detail::WorldParts<S> {
  using detail::WorldParts<S>::WorldParts;
};

namespace detail {

/// A World with one way of searching, for tests that compare them.
template <class S>
class WorldCore : public BasicWorld<S> {
  using Impl = typename BasicWorld<S>::Impl;

 public:
  explicit WorldCore(WorldOptions options = {}, SearchMode mode = SearchMode::cheapest)
      : WorldCore(std::make_unique<Impl>(options, mode)) {}

  /// The next updates search this way.
  void force(SearchMode mode) { parts_->force(mode); }
  /// How many rooms there are for the next update.
  std::size_t rooms() const { return parts_->rooms(); }

 private:
  explicit WorldCore(std::unique_ptr<Impl> impl) : WorldCore(impl.get(), std::move(impl)) {}
  WorldCore(Impl* parts, std::unique_ptr<Impl>&& impl) : BasicWorld<S>(std::move(impl)), parts_(parts) {}

  Impl* parts_;
};

}  // namespace detail
}  // namespace boxstream
