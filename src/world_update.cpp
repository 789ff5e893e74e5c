// SPDX-License-Identifier: MIT
#include <algorithm>
#include <stdexcept>

#include "world_core.hpp"

namespace boxstream::detail {

template <class S>
WorldStats WorldCore<S>::update() {
  return update_with(nullptr);
}

template <class S>
WorldStats WorldCore<S>::update(ProxyPairFilter accept) {
  return update_with(&accept);
}

/// Everything that can throw happens before anything that is remembered changes.
template <class S>
WorldStats WorldCore<S>::update_with(const ProxyPairFilter* accept) {
  WorldStats stats;
  stats.proxies = proxies_.live();
  stats.invalid = proxies_.invalid_count();
  stats.moved = proxies_.moved_since_update();

  pairs_.fold();
  if (proxies_.touched().empty() && pairs_.doubtful().empty()) {
    begun_.clear();
    ended_.clear();
    stats.pairs = pairs_.size();
    return stats;
  }

  SearchMode mode = forced_mode_;
  if (mode == SearchMode::cheapest) mode = search_.choose(proxies_, index_);
  PairLists& held = pairs_.lists();
  held.reserve_ranks(proxies_.ranks());
  if (mode == SearchMode::all)
    held.expect_all();
  else
    held.expect_of(proxies_.touched());
  fresh_.clear();
  stats.search = search_.run(mode, proxies_, index_, [&](Span<const Pair> found) {
    held.confirm(found, fresh_);
    if (fresh_.size() > most_begun_) throw std::length_error("boxstream: more pairs begin than the limit set");
  });
  if (mode != SearchMode::all) confirm_doubtful();

  sorter_.sort(fresh_, proxies_.ranks(), found_);
  if (mode != SearchMode::all)
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());  // doubtful twice over
  next_doubtful_.clear();
  if (accept != nullptr) ask(*accept);
  find_ended();
  name(found_, next_begun_);
  name(gone_, next_ended_);

  held.exchange(gone_, found_);
  pairs_.swap_doubtful(next_doubtful_);
  begun_.swap(next_begun_);
  ended_.swap(next_ended_);
  proxies_.settle();
  if (proxies_.needs_compaction())
    pairs_.remap(proxies_.compact([](std::uint32_t) { return false; }));  // no pair is held with a tombstone any more
  stats.pairs = pairs_.size();
  stats.begun = begun_.size();
  stats.ended = ended_.size();
  return stats;
}

/// A search for pairs with a touched end does not see those that were doubtful already and have not been touched since.
template <class S>
void WorldCore<S>::confirm_doubtful() {
  for (const PairKey key : pairs_.doubtful()) {
    const Pair pair{first_of(key), second_of(key)};
    if (is_touched(key)) continue;
    if (proxies_.touching(pair.a, pair.b) && accepts(proxies_.filter(pair.a), proxies_.filter(pair.b)))
      pairs_.lists().confirm(Span<const Pair>(&pair, 1), fresh_);
  }
}

/// Moves the pairs that are refused from the found ones to the doubtful ones.
template <class S>
void WorldCore<S>::ask(ProxyPairFilter accept) {
  std::size_t kept = 0;
  for (const PairKey key : found_) {
    const ProxyPair pair = named(key);
    if (accept(pair.a, pair.b))
      found_[kept++] = key;
    else
      next_doubtful_.push_back(key);
  }
  found_.resize(kept);
}

/// Held pairs that were to be found and were not: they overlap no more, or the filters refuse them.
template <class S>
void WorldCore<S>::find_ended() {
  gone_.clear();
  pairs_.lists().judge_missing([this](PairKey key) {
    if (options_.sticky_filters && proxies_.touching(first_of(key), second_of(key))) return false;
    gone_.push_back(key);
    return true;
  });
}

template <class S>
void WorldCore<S>::name(const std::vector<PairKey>& keys, std::vector<ProxyPair>& pairs) const {
  pairs.resize(keys.size());
  std::transform(keys.begin(), keys.end(), pairs.begin(), [this](PairKey key) { return named(key); });
}

#define INSTANTIATE(S)                        \
  template WorldStats WorldCore<S>::update(); \
  template WorldStats WorldCore<S>::update(ProxyPairFilter)
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
