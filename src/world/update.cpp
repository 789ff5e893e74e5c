// SPDX-License-Identifier: MIT
#include <algorithm>
#include <type_traits>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "world/core.hpp"
#include "world/fat_boxes/fat_boxes_simd.hpp"

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
  pairs_.fold();
  WorldStats stats{proxies_.live(), proxies_.invalid_count(), proxies_.moved_since_update(), 0, 0, 0, {}};
  if (pairs_.recheck().empty() && (proxies_.dirty().empty() || rooms_.hold(proxies_))) {
    proxies_.settle();
    if (has_events_) forget_changes();
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
  if (by_rows)
    compare_few(mode, accept);
  else
    search_and_compare(mode, accept, stats);
  if (!found_.empty() || !gone_.empty())
    apply_changes(by_rows);
  else if (has_events_)
    forget_changes();
  guard.fat_boxes = nullptr;
  const bool may_hold_more = !by_rows || has_events_ || !pairs_.recheck().empty();
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

template <class S>
SearchMode WorldParts<S>::choose() {
  const auto held = static_cast<std::size_t>(pairs_.lists().size());
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
  PairLists& held = pairs_.lists();
  held.reserve_ranks(proxies_.ranks());
  name(found_, next_begun_);
  name(gone_, next_ended_);
  if (is_merged_)
    held.take_merged();
  else
    held.exchange(next_ended_places_, found_, next_begun_places_);
  pairs_.lists_changed();
  if (by_rows) {
    for (const auto* keys : {&found_, &gone_})
      for (const PairKey key : *keys) rows_.flip(key);
    rows_.follow(pairs_.edition());
  }
  take_events();
}

template <class S>
void WorldParts<S>::take_events() noexcept {
  begun_.swap(next_begun_);
  ended_.swap(next_ended_);
  begun_places_.swap(next_begun_places_);
  ended_places_.swap(next_ended_places_);
  has_events_ = true;
}

template <class S>
WorldStats WorldParts<S>::update_told(Span<const ProxyPair> begin, Span<const ProxyPair> end, ProxyPairFilter accept) {
  const InUse::Change change(in_use_);
  rooms_.forget();
  keeps_refused_ = false;
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
    name(found_, next_begun_);
    name(gone_, next_ended_);
    pairs_.change(gone_, found_, next_ended_places_, next_begun_places_);
    take_events();
  }
  WorldStats stats;
  stats.proxies = proxies_.live();
  stats.invalid = proxies_.invalid_count();
  stats.pairs = pairs_.size();
  stats.begun = begun_.size();
  stats.ended = ended_.size();
  return stats;
}

/// Makes rooms, if their neighbours are found without making an index. If memory fails there are none.
template <class S>
void WorldParts<S>::fit_rooms() noexcept {
  const DefaultFloatEnvironment environment;
  const std::size_t ranks = proxies_.ranks();
  const bool scans = ranks <= thresholds.scanned_for_one || index_.needs_tree(0);
  if (scans && ranks > thresholds.scanned_for_rooms) return;
  try {
    const auto visit_near = [&](const Box& box, auto visit) {
      if (!scans)
        return index_.fresh(proxies_).for_each_overlap(box, [&](std::uint32_t slot) {
          visit(proxies_.rank_of_slot(slot));
          return true;
        });
      std::uint32_t touching[thresholds.portion];
      for (std::size_t first = 0; first < ranks; first += thresholds.portion) {
        const std::size_t size = std::min(thresholds.portion, ranks - first);
        const std::size_t count = find_overlapping(proxies_.boxes().data() + first, size, box, touching);
        for (std::size_t i = 0; i < count; ++i) visit(static_cast<std::uint32_t>(first) + touching[i]);
      }
    };
    if (!rooms_.fit(proxies_, pairs_, visit_near)) search_.choice().rooms_lasted(0);
  } catch (...) {
    rooms_.forget();
  }
}

/// What many pairs that begin or end at once take goes back after some updates with far fewer. `used` is how many the
/// last one had to do with.
template <class S>
void WorldParts<S>::give_back_unused(std::size_t used) noexcept {
  constexpr std::size_t little = 4096;
  constexpr unsigned patience = 8;
  const std::size_t scratch =
      std::max({all_found_.capacity(), fresh_.capacity(), found_.capacity(), gone_.capacity(), begun_.capacity(),
                next_begun_.capacity(), ended_.capacity(), next_ended_.capacity()});
  holds_much_ = scratch > little || pairs_.room() > little + 3 * pairs_.size();
  const bool lies_idle = holds_much_ && (scratch > little + 4 * used || pairs_.room() > little + 3 * pairs_.size());
  updates_with_less_ = lies_idle ? updates_with_less_ + 1 : 0;
  if (updates_with_less_ < patience) return;
  updates_with_less_ = 0;
  drop_scratch();
  sorter_.give_back();
  pairs_.give_back();
  search_.fat_boxes().give_back();
}

/// All lists of pairs but the events of the last update.
template <class S>
void WorldParts<S>::drop_scratch() noexcept {
  const auto drop = [](auto&... vectors) { (std::remove_reference_t<decltype(vectors)>().swap(vectors), ...); };
  drop(all_found_, fresh_, accepted_, ended_pairs_, found_, gone_, refused_, kept_);
  drop(next_begun_, next_ended_, next_begun_places_, next_ended_places_, is_referenced_);
  for (auto* events : {&begun_, &ended_}) events->shrink_to_fit();
  for (auto* places : {&begun_places_, &ended_places_}) places->shrink_to_fit();
}

/// Fills `found_` with what begins and `gone_` with what ends, in order, as do the others.
template <class S>
void WorldParts<S>::search_and_compare(SearchMode mode, const ProxyPairFilter* accept, Stats& stats) {
  const auto held = static_cast<std::size_t>(pairs_.lists().size());
  pairs_.lists().reserve_ranks(proxies_.ranks());
  refused_.clear();
  if (mode != SearchMode::candidates || search_.needs_rebuild(proxies_, held) || !compare_candidates(accept))
    compare_found(mode, accept, stats);
}

template <class S>
void WorldParts<S>::compare_found(SearchMode mode, const ProxyPairFilter* accept, Stats& stats) {
  PairLists& held = pairs_.lists();
  const bool of_all = mode == SearchMode::all || mode == SearchMode::candidates;
  if (of_all)
    held.expect_all();
  else
    held.expect_of(proxies_.dirty());
  fresh_.clear();
  accepted_.clear();
  keeps_refused_ = mode == SearchMode::candidates;
  const bool meets_refused = of_all && proxies_.dirty().size() < proxies_.ranks();
  const auto confirm_some = [&](Span<const Pair> found) {
    const std::size_t known = fresh_.size();
    held.confirm(found, search_.threads(), fresh_);
    if (meets_refused) leave_out_refused(known);
    check_begun(accepted_.size() + fresh_.size());
    // Candidates are few, and a search for them may have to be given up.
    if (accept != nullptr && !keeps_refused_ && fresh_.size() >= thresholds.asked_at_once) ask_early(*accept);
  };
  const auto confirm = [&](Span<const Pair> found) {
    const std::size_t portion = accept == nullptr ? found.size() : thresholds.asked_at_once * search_.threads().count();
    for (std::size_t first = 0; first < found.size(); first += portion)
      confirm_some(found.subspan(first, std::min(portion, found.size() - first)));
  };
  // Without a filter to ask, a search of all finds the next lists.
  bool merges = mode == SearchMode::all && accept == nullptr && !options_.sticky_filters && pairs_.recheck().empty() &&
                search_.threads().count() == 1;
  const std::size_t most_merged = thresholds.merged_of_rank * proxies_.ranks();
  const auto take = [&](Span<const Pair> found) {
    if (!merges) return confirm(found);
    all_found_.insert(all_found_.end(), found.begin(), found.end());
    check_begun(all_found_.size() - std::min<std::size_t>(held.size(), all_found_.size()));
    merges = all_found_.size() <= most_merged;
    if (!merges) confirm(all_found_);
  };
  if (mode != SearchMode::candidates)
    stats = search_.run(mode, proxies_, index_, take);
  else if (!search_.rebuild_candidates(proxies_, held.size(), confirm, stats))
    return compare_found(SearchMode::all, accept, stats);
  if (merges && merge_found(meets_refused)) return;
  if (merges) confirm(all_found_);
  recheck_released();

  sort_found();
  if (accept != nullptr) ask(*accept);
  take_accepted();
  find_ended();
  if (mode == SearchMode::candidates) {
    search_.fat_boxes().held_changed(refused_);
    search_.fat_boxes().held_changed(kept_);
    return;
  }
  search_.fat_boxes().held_changed(found_);
  search_.fat_boxes().held_changed(gone_);
}

/// The same of all pairs that there are. False if refused ones are among them.
template <class S>
bool WorldParts<S>::merge_found(bool meets_refused) {
  pairs_.lists().merge(all_found_, found_, next_begun_places_, gone_, next_ended_places_);
  if (meets_refused && !std::all_of(found_.begin(), found_.end(), [this](PairKey key) { return is_dirty(key); }))
    return false;
  check_begun(found_.size());
  kept_.clear();
  is_merged_ = true;
  search_.fat_boxes().held_changed(found_);
  search_.fat_boxes().held_changed(gone_);
  return true;
}

/// The same, by candidates. False if there are too many of them.
template <class S>
bool WorldParts<S>::compare_candidates(const ProxyPairFilter* accept) {
  if (!search_.scan_candidates(proxies_, pairs_.lists(), options_.sticky_filters, fresh_, ended_pairs_)) return false;
  if (fresh_.empty() && ended_pairs_.empty() && pairs_.recheck().empty()) {
    found_.clear();
    gone_.clear();
    next_ended_places_.clear();
    return true;
  }
  keeps_refused_ = true;
  pairs_.lists().expect_none();
  const std::size_t known = fresh_.size();
  recheck_released();
  for (std::size_t i = known; i < fresh_.size(); ++i)
    search_.fat_boxes().held_changed(pair_key(fresh_[i].a, fresh_[i].b));
  sort_found();
  check_begun(found_.size());
  sorter_.sort(ended_pairs_, proxies_.ranks(), gone_);
  pairs_.lists().find_places(gone_, next_ended_places_);
  if (accept != nullptr) ask(*accept);
  search_.fat_boxes().held_changed(refused_);
  return true;
}

/// Fresh pairs as keys.
template <class S>
void WorldParts<S>::sort_found() {
  sorter_.sort(fresh_, proxies_.ranks(), found_);
  if (!pairs_.recheck().empty())
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());  // a pair may have been released twice
}

/// Removes refused pairs from the fresh pairs from `first` on. A pair that overlaps, that group and mask accept and
/// that is not held has been refused, unless one of the two has changed since: so refusals need no memory.
template <class S>
void WorldParts<S>::leave_out_refused(std::size_t first) {
  const auto is_refused = [this](Pair pair) {
    if (proxies_.is_dirty(pair.a) || proxies_.is_dirty(pair.b)) return false;
    if (keeps_refused_) refused_.push_back(pair_key(pair.a, pair.b));
    return true;
  };
  fresh_.erase(std::remove_if(fresh_.begin() + static_cast<std::ptrdiff_t>(first), fresh_.end(), is_refused),
               fresh_.end());
}

template <class S>
void WorldParts<S>::recheck_released() {
  for_each_released(
      [this](const Pair pair) { pairs_.lists().confirm(Span<const Pair>(&pair, 1), search_.threads(), fresh_); });
}

/// Asks about the fresh pairs before all are found: pairs that are refused take no memory then, however many they are.
template <class S>
void WorldParts<S>::ask_early(ProxyPairFilter accept) {
  sort_found();
  ask(accept);
  for (const PairKey key : found_) accepted_.push_back({first_of(key), second_of(key)});
  fresh_.clear();
}

/// Puts the pairs that were accepted early to the found ones.
template <class S>
void WorldParts<S>::take_accepted() {
  if (accepted_.empty()) return;
  for (const PairKey key : found_) accepted_.push_back({first_of(key), second_of(key)});
  sorter_.sort(accepted_, proxies_.ranks(), found_);
  accepted_.clear();
}

/// Removes the pairs that are refused from the found ones.
template <class S>
void WorldParts<S>::ask(ProxyPairFilter accept) {
  std::size_t kept = 0;
  for (const PairKey key : found_) {
    const ProxyPair pair = named(key);
    if (accept(pair.a, pair.b))
      found_[kept++] = key;
    else if (keeps_refused_)
      refused_.push_back(key);
  }
  found_.resize(kept);
}

/// Held pairs that were expected and not found: they do not overlap any more, or the filters refuse them.
template <class S>
void WorldParts<S>::find_ended() {
  gone_.clear();
  kept_.clear();
  const auto is_gone = [&](PairKey key) {
    const bool stays = options_.sticky_filters && proxies_.touching(first_of(key), second_of(key));
    (stays ? kept_ : gone_).push_back(key);
    return !stays;
  };
  pairs_.lists().find_missing(is_gone, next_ended_places_);
}

template <class S>
void WorldParts<S>::forget_changes() noexcept {
  begun_.clear();
  ended_.clear();
  begun_places_.clear();
  ended_places_.clear();
  has_events_ = false;
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
  template void WorldParts<S>::ask(ProxyPairFilter);                                                             \
  template void WorldParts<S>::drop_scratch() noexcept;                                                          \
  template WorldStats BasicWorld<S>::update_told(Span<const ProxyPair>, Span<const ProxyPair>, ProxyPairFilter); \
  template WorldStats BasicWorld<S>::update(ProxyPairFilter)
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream
