// SPDX-License-Identifier: MIT
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
  stats.invalid = proxies_.invalid();
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

  next_held_.clear();
  next_doubtful_.clear();
  next_begun_.clear();
  next_ended_.clear();
  if (accept == nullptr)
    compare(held, complete, [](PairKey) { return true; });
  else
    compare(held, complete, [&](PairKey key) { return (*accept)(proxies_.id(first_of(key)), proxies_.id(second_of(key))); });

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
    if (proxies_.is_touched(a) || proxies_.is_touched(b)) continue;
    if (proxies_.touching(a, b) && accepts(proxies_.filter(a), proxies_.filter(b))) found.push_back({a, b});
  }
}

/// Whether a held pair that the search did not find is still held.
template <class S>
bool WorldCore<S>::goes_on(PairKey key, bool complete) const {
  const std::uint32_t a = first_of(key);
  const std::uint32_t b = second_of(key);
  if (!complete && !proxies_.is_touched(a) && !proxies_.is_touched(b)) return true;
  return options_.sticky_filters && proxies_.touching(a, b);
}

/// Merges the pairs found with those held, both sorted, into the lists of what comes next.
template <class S>
template <class Accept>
void WorldCore<S>::compare(const std::vector<PairKey>& held, bool complete, Accept&& accept) {
  auto old = held.begin();
  const auto pass_held = [&] {
    if (goes_on(*old, complete))
      next_held_.push_back(*old);
    else
      next_ended_.push_back(named(*old));
    ++old;
  };
  const PairKey* previous = nullptr;
  for (const PairKey& key : found_) {
    if (previous != nullptr && *previous == key) continue;  // doubtful twice over
    previous = &key;
    while (old != held.end() && *old < key) pass_held();
    if (old != held.end() && *old == key) {
      next_held_.push_back(key);
      ++old;
    } else if (accept(key)) {
      next_held_.push_back(key);
      next_begun_.push_back(named(key));
    } else {
      next_doubtful_.push_back(key);
    }
  }
  while (old != held.end()) pass_held();
}

#define INSTANTIATE(S)                         \
  template WorldStats WorldCore<S>::update();  \
  template WorldStats WorldCore<S>::update(ProxyPairFilter)
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
