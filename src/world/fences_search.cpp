// SPDX-License-Identifier: MIT
#include "world/fences.hpp"

#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

namespace boxstream::detail {

namespace {

/// As `overlaps`, without branches: most candidates of a pass overlap, some do not, and which is hard to predict.
template <class S>
bool share_a_point(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  bool share = true;
  for (int d = 0; d < 3; ++d) share = share & (a.min[d] <= b.max[d]) & (b.min[d] <= a.max[d]);
  return share;
}

}  // namespace

template <class S>
bool Fences<S>::search(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters, Detector& detector,
                       std::vector<PairKey>& begun, std::vector<PairKey>& ended, Stats& stats) {
  struct DropUnlessDone {
    Fences& fences;
    bool done = false;
    ~DropUnlessDone() {
      if (!done) fences.drop();
    }
  } guard{*this};
  begun.clear();
  ended.clear();
  const std::size_t most = most_candidates(proxies.ranks(), held.size());
  const Task task{proxies, held, sticky_filters, most, begun, ended};
  if (!stand_ || 4 * escaped_.size() > proxies.ranks()) {
    if (!renew_all(task, detector, stats)) return false;
  } else {
    correct_changed(held);
    if (!escaped_.empty() && !renew_escaped(task)) return false;
  }
  for (const std::uint32_t rank : escaped_) has_escaped_[rank] = false;
  escaped_since_purge_ += escaped_.size();
  escaped_.clear();
  if (must_purge_ || 8 * escaped_since_purge_ > proxies.ranks()) purge(task);

  pass(candidates_, task);
  pass(recent_, task);
  stand_ = guard.done = true;
  return true;
}

/// Most candidates are held and go on, or are not and do not begin. Those that overlap without being held have been
/// refused, unless one of the two was touched.
template <class S>
void Fences<S>::pass(std::vector<Candidate>& candidates, const Task& task) {
  const DefaultFloatEnvironment environment;
  const Span<const Box> boxes = task.proxies.boxes();
  for (Candidate& candidate : candidates) {
    const std::uint32_t a = first_of(key_of(candidate)), b = second_of(key_of(candidate));
    const bool overlap = share_a_point(boxes[a], boxes[b]);
    if (overlap == is_held(candidate)) continue;
    // Filters may have come to refuse it while it was held.
    if (!is_held(candidate) && (!(task.proxies.is_touched(a) || task.proxies.is_touched(b)) ||
                                !accepts(task.proxies.filter(a), task.proxies.filter(b))))
      continue;
    (is_held(candidate) ? task.ended : task.begun).push_back(key_of(candidate));
    candidate ^= 1;
  }
}

template <class S>
void Fences<S>::held_changed(Span<const PairKey> keys) noexcept {
  if (!stand_) return;
  // Without an end, if other ways to search go on being cheaper.
  if (changed_.size() + keys.size() > candidates_.size() + recent_.size() + 8 * fences_.size()) return drop();
  try {
    changed_.insert(changed_.end(), keys.begin(), keys.end());
  } catch (...) {
    drop();
  }
}

/// Pairs that are held by now without having been candidates become some: their boxes, and so their fences, may have
/// parted since.
template <class S>
void Fences<S>::correct_changed(const PairLists& held) {
  if (changed_.empty()) return;
  if (rows_.empty()) index_rows(fences_.size());
  fresh_.clear();
  for (const PairKey key : changed_) {
    const bool is_held = held.contains(key);
    const Candidate corrected = key << 1 | (is_held ? 1 : 0);
    if (const std::size_t at = place(key); at != candidates_.size()) {
      candidates_[at] = corrected;
      continue;
    }
    const auto at = std::lower_bound(recent_.begin(), recent_.end(), key << 1);
    if (at != recent_.end() && key_of(*at) == key)
      *at = corrected;
    else if (is_held)
      fresh_.push_back(corrected);
  }
  changed_.clear();
  add_fresh();
}

/// Those that are not among the recent ones yet. The same candidate may be there several times.
template <class S>
void Fences<S>::add_fresh() {
  if (fresh_.empty()) return;
  std::sort(fresh_.begin(), fresh_.end());
  fresh_.erase(std::unique(fresh_.begin(), fresh_.end()), fresh_.end());
  merged_.resize(recent_.size() + fresh_.size());
  merged_.erase(std::set_union(recent_.begin(), recent_.end(), fresh_.begin(), fresh_.end(), merged_.begin()),
                merged_.end());
  recent_.swap(merged_);
}

template <class S>
bool Fences<S>::renew_all(const Task& task, Detector& detector, Stats& stats) {
  const ProxyTable<S>& proxies = task.proxies;
  grow_to(proxies.ranks());
  raise_all(proxies);
  pairs_.clear();
  bool fits = true;
  const auto keep = [&](Span<const Pair> pairs) {
    fits = pairs_.size() + pairs.size() <= task.most;
    if (fits) pairs_.insert(pairs_.end(), pairs.begin(), pairs.end());
    return fits;
  };
  stats = detector.stream_pairs(Span<const Box>(fences_), keep, proxies.batch_filters());
  if (!fits) return false;
  sorter_.sort(pairs_, proxies.ranks(), candidates_);
  for (Candidate& candidate : candidates_) candidate <<= 1;
  mark_held(task);
  index_rows(proxies.ranks());
  changed_.clear();
  escaped_since_purge_ = 0;
  must_purge_ = false;
  return true;
}

/// Held pairs that are no candidates have ended, unless only the filters are against them.
template <class S>
void Fences<S>::mark_held(const Task& task) {
  recent_.clear();
  auto next = candidates_.begin();
  task.held.for_each([&](PairKey key) {
    while (next != candidates_.end() && key_of(*next) < key) ++next;
    if (next != candidates_.end() && key_of(*next) == key)
      *next |= 1;
    else if (task.sticky_filters && task.proxies.touching(first_of(key), second_of(key)))
      recent_.push_back(key << 1 | 1);
    else
      task.ended.push_back(key);
    return true;
  });
}

template <class S>
bool Fences<S>::renew_escaped(const Task& task) {
  const DefaultFloatEnvironment environment;
  for (const std::uint32_t rank : escaped_) raise(rank, task.proxies.box(rank));
  if (rows_.empty()) index_rows(task.proxies.ranks());
  fresh_.clear();
  if (!probe_escaped(task)) return false;
  for (Candidate& candidate : fresh_) candidate |= task.held.contains(key_of(candidate)) ? 1 : 0;
  add_fresh();
  return true;
}

template <class S>
bool Fences<S>::probe_escaped(const Task& task) {
  if (!is_indexed_) {
    index_.reserve_slots(fences_.size());
    for (std::uint32_t rank = 0; rank < fences_.size(); ++rank) index_.mark(rank);
    is_indexed_ = true;
  }
  index_.refresh([this](std::uint32_t rank) { return fences_[rank]; });
  asking_.clear();
  asking_fences_.clear();
  for (const std::uint32_t rank : escaped_) {
    if (!task.proxies.is_valid(rank)) continue;
    asking_.push_back(rank);
    asking_fences_.push_back(fences_[rank]);
  }
  const Span<const Filter> filters = task.proxies.batch_filters();
  const std::size_t known = candidates_.size() + recent_.size();
  bool fits = true;
  const auto keep = [&](Span<const Pair> pairs) {
    fits = fits && known + fresh_.size() <= task.most;
    if (!fits) return;
    for (const Pair p : pairs) {
      const std::uint32_t rank = asking_[p.a];
      // Two escaped proxies meet twice, and each one meets itself.
      if (p.b <= rank && has_escaped_[p.b]) continue;
      const PairKey key = pair_key(rank, p.b);
      if (!filters.empty() && !accepts(filters[rank], filters[p.b]) &&
          !(task.sticky_filters && task.held.contains(key)))
        continue;
      if (place(key) == candidates_.size()) fresh_.push_back(key << 1);
    }
  };
  index_.find_overlaps(asking_fences_, walk_, keep);
  return fits;
}

/// Among the older candidates only; their number if it is not there.
template <class S>
std::size_t Fences<S>::place(PairKey key) const {
  const std::size_t row = first_of(key);
  if (row + 1 >= rows_.size()) return candidates_.size();  // younger than the rows
  const auto begin = candidates_.begin() + rows_[row], end = candidates_.begin() + rows_[row + 1];
  const auto at = std::lower_bound(begin, end, key << 1);
  return at != end && key_of(*at) == key ? static_cast<std::size_t>(at - candidates_.begin()) : candidates_.size();
}

/// Merges recent candidates into the others and leaves out those that have parted.
template <class S>
void Fences<S>::purge(const Task& task) {
  const DefaultFloatEnvironment environment;
  const ProxyTable<S>& proxies = task.proxies;
  merged_.resize(candidates_.size() + recent_.size());
  std::merge(candidates_.begin(), candidates_.end(), recent_.begin(), recent_.end(), merged_.begin());
  recent_.clear();
  std::size_t kept = 0;
  for (const Candidate candidate : merged_) {
    const std::uint32_t a = first_of(key_of(candidate)), b = second_of(key_of(candidate));
    // A box that is not there has an inverted fence, which can look as if it overlapped an unbounded one.
    const bool stays =
        share_a_point(fences_[a], fences_[b]) &&
        (!must_purge_ ||
         (has_valid_keys(fences_[a]) && has_valid_keys(fences_[b]) &&
          (accepts(proxies.filter(a), proxies.filter(b)) || (task.sticky_filters && is_held(candidate)))));
    if (stays)
      merged_[kept++] = candidate;
    else if (is_held(candidate))
      task.ended.push_back(key_of(candidate));
  }
  merged_.resize(kept);
  candidates_.swap(merged_);
  index_rows(proxies.ranks());
  escaped_since_purge_ = 0;
  must_purge_ = false;
}

template <class S>
void Fences<S>::index_rows(std::size_t ranks) {
  rows_.clear();
  reserve_more(rows_, ranks + 1);
  rows_.resize(ranks + 1, 0);
  for (const Candidate candidate : candidates_) ++rows_[first_of(key_of(candidate)) + 1];
  for (std::size_t i = 1; i < rows_.size(); ++i) rows_[i] += rows_[i - 1];
}

#define INSTANTIATE(S)                                                                                            \
  template bool Fences<S>::search(const ProxyTable<S>&, const PairLists&, bool, Detector&, std::vector<PairKey>&, \
                                  std::vector<PairKey>&, Stats&);                                                 \
  template void Fences<S>::held_changed(Span<const PairKey>) noexcept
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
