// SPDX-License-Identifier: MIT
#include <algorithm>

#include "base/thresholds.hpp"
#include "world/core.hpp"

namespace boxstream {

using namespace detail;

template <class S>
WorldStats BasicWorld<S>::update() {
  return impl_->update_with(nullptr);
}

template <class S>
WorldStats BasicWorld<S>::update(ProxyPairFilter accept) {
  return impl_->update_with(&accept);
}

template <class S>
WorldStats BasicWorld<S>::update_told(Span<const ProxyPair> begin, Span<const ProxyPair> end, ProxyPairFilter accept) {
  return impl_->update_told(begin, end, accept);
}

template <class S>
void BasicWorld<S>::set_max_begun(std::uint64_t most) {
  const InUse::Change change(impl_->in_use_);
  impl_->most_begun_ = most;
}

template <class S>
Span<const ProxyPair> BasicWorld<S>::begun() const {
  return impl_->begun_;
}

template <class S>
Span<const ProxyPair> BasicWorld<S>::ended() const {
  return impl_->ended_;
}

template <class S>
Splice BasicWorld<S>::changes() const {
  return {impl_->ended_places_, impl_->begun_places_};
}

/// Where nothing has changed, or nothing that matters, there is nothing to do but to count.
template <class S>
WorldStats WorldParts<S>::update_with(const ProxyPairFilter* accept) {
  const InUse::Change change(in_use_);
  WorldStats stats{proxies_.live(), proxies_.invalid_count(), proxies_.moved_since_update(), 0, 0, 0, {}};
  if (pairs_.recheck().empty() && (proxies_.dirty().empty() || rooms_.hold(proxies_))) {
    proxies_.settle();
    if (has_events()) forget_changes();
    if (holds_much_) give_back_unused(0);
  } else {
    search(accept, stats.search);
    stats.begun = begun_.size();
    stats.ended = ended_.size();
  }
  stats.pairs = pairs_.size();
  return stats;
}

/// Everything that can throw comes before the first change of what is held. Candidates are a cache that changes on the
/// way: an update that throws forgets them.
template <class S>
void WorldParts<S>::search(const ProxyPairFilter* accept, Stats& stats) {
  const typename Rooms<S>::Left rooms = rooms_.leave(proxies_);
  if (rooms.were_there) search_.choice().rooms_lasted(rooms.lasted);
  const bool try_rooms = rooms.moves_again && forced_mode_ == SearchMode::cheapest && search_.choice().tries_rooms();
  struct DropUnlessDone {
    LazyFatBoxes<S>* fat_boxes;
    ~DropUnlessDone() {
      if (fat_boxes != nullptr) fat_boxes->drop();
    }
  } guard{&search_.fat_boxes()};
  is_merged_ = false;
  all_found_.clear();
  const SearchMode mode = choose();
  const bool by_rows = mode == SearchMode::rows || mode == SearchMode::dirty_rows;
  is_of_few_ = is_of_few(mode);
  if (!is_of_few_) pairs_.fold();
  if (by_rows)
    compare_few(mode, accept);
  else
    search_and_compare(mode, accept, stats);
  if (!found_.empty() || !gone_.empty())
    apply_changes(by_rows);
  else if (has_events())
    forget_changes();
  guard.fat_boxes = nullptr;
  const bool may_hold_more = !by_rows || has_events() || !pairs_.recheck().empty();
  pairs_.clear_recheck();
  proxies_.settle();
  if (proxies_.needs_compaction()) {
    const auto new_rank = proxies_.compact([](std::uint32_t) { return false; });  // no pair is held with a tombstone
    pairs_.remap(new_rank);
    search_.fat_boxes().remap(new_rank);
  } else if (try_rooms && !search_.fat_boxes().is_active()) {
    fit_rooms();
  }
  if (may_hold_more || holds_much_)
    give_back_unused(
        std::max({all_found_.size(), fresh_.size(), found_.size(), gone_.size(), kept_.size(), refused_.size()}));
}

/// True for an update that looks at the pairs of the dirty proxies only, and leaves the others where they are. Where
/// rows say what is held the others are few.
template <class S>
bool WorldParts<S>::is_of_few(SearchMode mode) const {
  if (mode != SearchMode::probe && mode != SearchMode::beside) return false;
  return proxies_.dirty().size() <= thresholds.listed_one_by_one && pairs_.recheck().empty() &&
         !proxies_.needs_compaction();
}

template <class S>
SearchMode WorldParts<S>::choose() {
  const auto held = static_cast<std::size_t>(pairs_.size());
  const bool is_few = forced_mode_ == SearchMode::cheapest && proxies_.keep_few();
  if (is_few && !search_.fat_boxes().is_active()) {
    const auto few = SearchChoice::choose_of_few(proxies_.ranks(), proxies_.dirty().size(), held);
    if (few.is_final) {
      if (few.mode == SearchMode::all) search_.begin_update(proxies_, false);
      return few.mode;
    }
  }
  if (!is_few) rows_.drop();
  const bool is_free = forced_mode_ == SearchMode::cheapest;
  const bool may_keep = is_free || forced_mode_ == SearchMode::candidates || search_.fat_boxes().is_active();
  search_.begin_update(proxies_, may_keep);
  return is_free ? search_.choose(proxies_, index_, held, is_few) : forced_mode_;
}

/// What was found begins, and what is gone ends. May throw, and has then done nothing.
template <class S>
void WorldParts<S>::apply_changes(bool by_rows) {
  name(found_, next_begun_);
  name(gone_, next_ended_);
  if (is_of_few_) {
    pairs_.exchange_few(gone_, next_ended_places_, found_, next_begun_places_);
  } else {
    PairLists& held = pairs_.lists();
    held.reserve_ranks(proxies_.ranks());
    if (is_merged_)
      held.take_merged();
    else
      held.exchange(next_ended_places_, found_, next_begun_places_);
    pairs_.lists_changed();
  }
  if (by_rows) {
    for (const auto* keys : {&found_, &gone_})
      for (const PairKey key : *keys) rows_.flip(key);
    rows_.follow(pairs_.edition());
  }
  begun_.swap(next_begun_);
  ended_.swap(next_ended_);
  begun_places_.swap(next_begun_places_);
  ended_places_.swap(next_ended_places_);
}

template <class S>
WorldStats WorldParts<S>::update_told(Span<const ProxyPair> begin, Span<const ProxyPair> end, ProxyPairFilter accept) {
  const InUse::Change change(in_use_);
  rooms_.forget();
  is_merged_ = keeps_refused_ = false;
  const auto fill = [this](Span<const ProxyPair> pairs, bool are_held, std::vector<PairKey>& keys) {
    keys.clear();
    for (const ProxyPair& pair : pairs) {
      const std::uint32_t a = proxies_.rank(pair.a), b = proxies_.rank(pair.b);
      if (a == Proxies::none || b == Proxies::none || a == b) continue;
      if (const PairKey key = pair_key(a, b); pairs_.contains(key) == are_held) keys.push_back(key);
    }
    std::sort(keys.begin(), keys.end());
    keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  };
  fill(begin, false, found_);
  fill(end, true, gone_);
  check_begun(found_.size());
  ask(accept);
  if (found_.empty() && gone_.empty()) {
    forget_changes();
  } else {
    search_.fat_boxes().held_changed(found_);
    search_.fat_boxes().held_changed(gone_);
    pairs_.find_places(gone_, next_ended_places_);
    is_of_few_ = found_.size() + gone_.size() <= thresholds.longest_side_list_of_updates;
    if (!is_of_few_) pairs_.fold();
    apply_changes(false);
  }
  if (has_events() || holds_much_) give_back_unused(std::max(found_.size(), gone_.size()));
  WorldStats stats;
  stats.proxies = proxies_.live();
  stats.invalid = proxies_.invalid_count();
  stats.pairs = pairs_.size();
  stats.begun = begun_.size();
  stats.ended = ended_.size();
  return stats;
}

template <class S>
void WorldParts<S>::forget_changes() noexcept {
  begun_.clear();
  ended_.clear();
  begun_places_.clear();
  ended_places_.clear();
}

template <class S>
void WorldParts<S>::name(const std::vector<PairKey>& keys, std::vector<ProxyPair>& pairs) const {
  pairs.resize(keys.size());
  std::transform(keys.begin(), keys.end(), pairs.begin(), [this](PairKey key) { return named(key); });
}

#define INSTANTIATE(S)                                                                                           \
  template void BasicWorld<S>::set_max_begun(std::uint64_t);                                                     \
  template Span<const ProxyPair> BasicWorld<S>::begun() const;                                                   \
  template Span<const ProxyPair> BasicWorld<S>::ended() const;                                                   \
  template Splice BasicWorld<S>::changes() const;                                                                \
  template WorldStats BasicWorld<S>::update();                                                                   \
  template void WorldParts<S>::forget_changes() noexcept;                                                        \
  template WorldStats BasicWorld<S>::update_told(Span<const ProxyPair>, Span<const ProxyPair>, ProxyPairFilter); \
  template WorldStats BasicWorld<S>::update(ProxyPairFilter)
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
