// SPDX-License-Identifier: MIT
#include <algorithm>

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

  const std::vector<PairKey>& held = pairs_.fold();
  if (proxies_.touched().empty() && pairs_.doubtful().empty()) {
    begun_.clear();
    ended_.clear();
    stats.pairs = held.size();
    return stats;
  }

  SearchMode mode = forced_mode_;
  if (mode == SearchMode::cheapest) mode = search_.choose(proxies_, index_);
  stats.search = search_.run(mode, proxies_, index_);
  const bool complete = mode == SearchMode::all;
  if (!complete) add_doubtful(search_.found());
  sorter_.sort(search_.found(), proxies_.ranks(), found_);
  if (!complete) found_.erase(std::unique(found_.begin(), found_.end()), found_.end());  // doubtful twice over

  next_held_.clear();
  next_doubtful_.clear();
  next_begun_.clear();
  next_ended_.clear();
  if (accept == nullptr)
    compare(held, complete, [](PairKey) { return true; });
  else
    compare(held, complete,
            [&](PairKey key) { return (*accept)(proxies_.id(first_of(key)), proxies_.id(second_of(key))); });

  pairs_.replace(next_held_, next_doubtful_);
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
void WorldCore<S>::add_doubtful(std::vector<Pair>& found) const {
  for (const PairKey key : pairs_.doubtful()) {
    const std::uint32_t a = first_of(key);
    const std::uint32_t b = second_of(key);
    if (is_touched(key)) continue;
    if (proxies_.touching(a, b) && accepts(proxies_.filter(a), proxies_.filter(b))) found.push_back({a, b});
  }
}

/// Merges the pairs found with those held, both sorted, into the lists of what comes next.
template <class S>
template <class Accept>
void WorldCore<S>::compare(const std::vector<PairKey>& held, bool complete, Accept&& accept) {
  const PairKey* old = held.data();
  const PairKey* const old_end = old + held.size();
  const PairKey* key = found_.data();
  const PairKey* const key_end = key + found_.size();
  while (key != key_end || old != old_end) {
    // Most pairs go on, either found again or out of the reach of the search: take them in runs.
    const PairKey* const run = old;
    for (; old != old_end && key != key_end && *old == *key; ++old) ++key;
    if (!complete) {
      const PairKey next = key == key_end ? ~PairKey{0} : *key;
      while (old != old_end && *old < next && !is_touched(*old)) ++old;
    }
    next_held_.insert(next_held_.end(), run, old);

    if (old != old_end && (key == key_end || *old < *key)) {
      if (options_.sticky_filters && proxies_.touching(first_of(*old), second_of(*old)))
        next_held_.push_back(*old);
      else
        next_ended_.push_back(named(*old));
      ++old;
    } else if (key != key_end && (old == old_end || *key < *old)) {
      if (accept(*key)) {
        next_held_.push_back(*key);
        next_begun_.push_back(named(*key));
      } else {
        next_doubtful_.push_back(*key);
      }
      ++key;
    }
  }
}

#define INSTANTIATE(S)                        \
  template WorldStats WorldCore<S>::update(); \
  template WorldStats WorldCore<S>::update(ProxyPairFilter)
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
