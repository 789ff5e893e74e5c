// SPDX-License-Identifier: MIT
// What a search finds beside what is held: the pairs that begin and end.
#include <algorithm>

#include "base/thresholds.hpp"
#include "world/core.hpp"

namespace boxstream::detail {

/// Fills `found_` with what begins and `gone_` with what ends, in order, as do the others.
template <class S>
void WorldParts<S>::search_and_compare(SearchMode mode, const ProxyPairFilter* accept, Stats& stats) {
  const auto held = static_cast<std::size_t>(pairs_.size());
  if (!is_of_few_) pairs_.lists().reserve_ranks(proxies_.ranks());
  refused_.clear();
  if (mode != SearchMode::candidates || search_.needs_rebuild(proxies_, held) || !compare_candidates(accept))
    compare_found(mode, accept, stats);
}

template <class S>
void WorldParts<S>::compare_found(SearchMode mode, const ProxyPairFilter* accept, Stats& stats) {
  const bool of_all = mode == SearchMode::all || mode == SearchMode::candidates;
  if (is_of_few_)
    pairs_of_few_.expect(pairs_, proxies_.dirty());
  else if (of_all)
    pairs_.lists().expect_all();
  else
    pairs_.lists().expect_of(proxies_.dirty());
  fresh_.clear();
  accepted_.clear();
  keeps_refused_ = mode == SearchMode::candidates;
  const bool meets_refused = of_all && proxies_.dirty().size() < proxies_.ranks();
  const auto confirm_some = [&](Span<const Pair> found) {
    const std::size_t known = fresh_.size();
    if (is_of_few_)
      pairs_of_few_.confirm(found, fresh_);
    else
      pairs_.lists().confirm(found, search_.threads(), fresh_);
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
    check_begun(all_found_.size() - std::min<std::size_t>(pairs_.size(), all_found_.size()));
    merges = all_found_.size() <= most_merged;
    if (!merges) confirm(all_found_);
  };
  if (mode != SearchMode::candidates)
    stats = search_.run(mode, proxies_, index_, take);
  else if (!search_.rebuild_candidates(proxies_, pairs_.size(), confirm, stats))
    return compare_found(SearchMode::all, accept, stats);
  if (merges && merge_found(meets_refused)) return;
  if (merges) confirm(all_found_);
  recheck_released();

  sort_found();
  check_begun(accepted_.size() + found_.size());
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
  if (is_of_few_)
    pairs_of_few_.find_missing(pairs_, is_gone, next_ended_places_);
  else
    pairs_.lists().find_missing(is_gone, next_ended_places_);
}

#define INSTANTIATE(S)                                                                         \
  template void WorldParts<S>::search_and_compare(SearchMode, const ProxyPairFilter*, Stats&); \
  template void WorldParts<S>::ask(ProxyPairFilter)
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
