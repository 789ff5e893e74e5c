// SPDX-License-Identifier: MIT
#include <algorithm>

#include <boxstream/detail/float_environment.hpp>

#include "world/fences/fences.hpp"
#include "world/fences/fences_simd.hpp"

namespace boxstream::detail {

namespace {

Pair pair_of(PairKey key) {
  return {first_of(key), second_of(key)};
}

template <class S>
Made candidates_among(const BasicAabb<S>* boxes, const BasicAabb<S>* cores, Span<const Pair> pairs,
                      std::uint64_t* doubtful, std::uint64_t* sure, Pair* overlapping) {
  const DefaultFloatEnvironment environment;
  return make_candidates(boxes, cores, pairs.data(), pairs.size(), doubtful, sure, overlapping);
}

/// Adds so many elements, and returns the first.
template <class T>
T* add_elements(std::vector<T>& all, std::size_t count) {
  const std::size_t known = all.size();
  reserve_more(all, count);
  all.resize(known + count);
  return all.data() + known;
}

}  // namespace

template <class S>
bool Fences<S>::renew(const ProxyTable<S>& proxies, std::size_t pairs, Detector& detector,
                      FunctionRef<void(Span<const Pair>)> sink, Stats& stats) {
  grow_to(proxies.ranks());
  spent_ = renewal_price(proxies.ranks(), pairs, kept());
  spent_on_escapes_ = 0;
  updates_ = 1;
  {
    const DefaultFloatEnvironment environment;
    planned_ = best_plan(proxies.touched().size(), proxies.ranks(), pairs).updates;
    raise_all(proxies, pairs);
  }
  candidates_.clear();
  sure_.clear();
  changed_.clear();
  const std::size_t most = most_candidates(proxies.ranks(), pairs);
  const Span<const Box> boxes = proxies.boxes();
  bool fits = true;
  const auto keep = [&](Span<const Pair> found) {
    constexpr std::size_t batch = 512;
    fits = kept() + found.size() <= most;
    for (std::size_t first = 0; fits && first < found.size(); first += batch) {
      const Span<const Pair> some = found.subspan(first, std::min(batch, found.size() - first));
      const std::size_t known = candidates_.size(), known_sure = sure_.size();
      Candidate* const doubtful = add_elements(candidates_, some.size());
      Candidate* const sure = add_elements(sure_, some.size());
      Pair overlapping[batch];
      const Made made = candidates_among(boxes.data(), cores(0), some, doubtful, sure, overlapping);
      candidates_.resize(known + made.doubtful);
      sure_.resize(known_sure + made.sure);
      sink({overlapping, made.overlapping});
    }
    return fits;
  };
  stats = detector.stream_pairs(Span<const Box>(fences_.data(), proxies.ranks()), keep, proxies.batch_filters());
  if (!fits) return false;
  for (const std::uint32_t rank : escaped_) has_escaped_[rank] = false;
  escaped_.clear();
  index_.clear();
  is_indexed_ = false;
  return stand_ = true;
}

template <class S>
bool Fences<S>::search(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters,
                       std::vector<Pair>& begun, std::vector<Pair>& ended) {
  begun.clear();
  ended.clear();
  const std::size_t most = most_candidates(proxies.ranks(), static_cast<std::size_t>(held.size()));
  const Task task{proxies, held, sticky_filters, most, begun, ended};
  const std::size_t escape = escape_price();
  spent_on_escapes_ += escape;
  spent_ += walk_price(proxies.touched().size(), candidates_.size()) + escape;
  ++updates_;
  correct_changed(task);
  if (!escaped_.empty() && !renew_escaped(task)) return false;
  pass(task);
  return true;
}

template <class S>
bool Fences<S>::Task::stays(PairKey key) const {
  const std::uint32_t a = first_of(key), b = second_of(key);
  return proxies.touching(a, b) && (sticky_filters || accepts(proxies.filter(a), proxies.filter(b)));
}

/// A candidate may be one that the filters have refused since it began, and that was held on until it parted.
template <class S>
bool Fences<S>::Task::may_begin(Pair pair) const {
  return (proxies.is_touched(pair.a) || proxies.is_touched(pair.b)) &&
         accepts(proxies.filter(pair.a), proxies.filter(pair.b));
}

/// Most candidates are held and go on, or are not and do not begin. Those that overlap without being held have been
/// refused, unless one of the two was touched.
template <class S>
void Fences<S>::pass(const Task& task) {
  const DefaultFloatEnvironment environment;
  const Span<const Box> boxes = task.proxies.boxes();
  constexpr std::size_t batch = 256;
  for (std::size_t first = 0; first < candidates_.size(); first += batch) {
    Candidate* const some = candidates_.data() + first;
    const std::size_t size = std::min(batch, candidates_.size() - first);
    std::uint32_t differ[batch];
    const std::size_t count = find_changed(boxes.data(), some, size, differ);
    for (std::size_t i = 0; i < count; ++i) {
      Candidate& candidate = some[differ[i]];
      const Pair pair = pair_of(key_of(candidate));
      if (!is_held(candidate) && !task.may_begin(pair)) continue;
      (is_held(candidate) ? task.ended : task.begun).push_back(pair);
      candidate ^= 1;
    }
  }
}

template <class S>
void Fences<S>::held_changed(Span<const PairKey> keys) noexcept {
  if (!stand_ || keys.empty()) return;
  // Without an end, if other ways to search go on being cheaper.
  if (changed_.size() + keys.size() > candidates_.size() + 8 * fences_.size()) return drop();
  try {
    changed_.insert(changed_.end(), keys.begin(), keys.end());
  } catch (...) {
    drop();
  }
}

/// Pairs that are held by now without having been candidates become some: their boxes, and so their fences, may have
/// parted since.
template <class S>
void Fences<S>::correct_changed(const Task& task) {
  if (changed_.empty()) return;
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  constexpr std::uint8_t marked = 2;
  for (const PairKey key : changed_) has_escaped_[first_of(key)] |= marked;
  for (std::vector<Candidate>* candidates : {&candidates_, &sure_})
    std::erase_if(*candidates, [&](Candidate candidate) {
      const PairKey key = key_of(candidate);
      return (has_escaped_[first_of(key)] & marked) != 0 && std::binary_search(changed_.begin(), changed_.end(), key);
    });
  for (const PairKey key : changed_) {
    has_escaped_[first_of(key)] &= static_cast<std::uint8_t>(~marked);
    const std::uint32_t a = first_of(key), b = second_of(key);
    const bool is_held = task.held.contains(key);
    if (is_held && !task.stays(key))
      task.ended.push_back(pair_of(key));
    else if (is_held ||
             (has_valid_keys(fences_[a]) && has_valid_keys(fences_[b]) && overlap_by_keys(fences_[a], fences_[b]) &&
              accepts(task.proxies.filter(a), task.proxies.filter(b))))
      candidates_.push_back(key << 1 | (is_held ? 1 : 0));
  }
  changed_.clear();
}

template <class S>
bool Fences<S>::renew_escaped(const Task& task) {
  const DefaultFloatEnvironment environment;
  drop_escaped(task, candidates_);
  drop_escaped(task, sure_);
  for (const std::uint32_t rank : escaped_) raise_again(rank, task.proxies.box(rank));
  if (!probe_escaped(task)) return false;
  for (const std::uint32_t rank : escaped_) has_escaped_[rank] = false;
  escaped_.clear();
  return true;
}

/// All their candidates; those that are to go on are found again.
template <class S>
void Fences<S>::drop_escaped(const Task& task, std::vector<Candidate>& candidates) {
  std::erase_if(candidates, [&](Candidate candidate) {
    const PairKey key = key_of(candidate);
    if ((has_escaped_[first_of(key)] | has_escaped_[second_of(key)]) == 0) return false;
    if (is_held(candidate) && !task.stays(key)) task.ended.push_back(pair_of(key));
    return true;
  });
}

/// Few look at all fences, for which no index has to be made; many ask the index.
template <class S>
bool Fences<S>::probe_escaped(const Task& task) {
  asking_.clear();
  for (const std::uint32_t rank : escaped_)
    if (task.proxies.is_valid(rank)) asking_.push_back(rank);
  if (scans()) {
    for (const std::uint32_t rank : asking_)
      if (!scan(task, rank)) return false;
    return true;
  }
  if (!is_indexed_) {
    index_.reserve_slots(fences_.size());
    for (std::uint32_t rank = 0; rank < fences_.size(); ++rank) index_.mark(rank);
    is_indexed_ = true;
  }
  index_.refresh([this](std::uint32_t rank) { return fences_[rank]; });
  asking_fences_.clear();
  for (const std::uint32_t rank : asking_) asking_fences_.push_back(fences_[rank]);
  bool fits = true;
  const auto keep = [&](Span<const Pair> pairs) {
    fits = fits && kept() <= task.most;
    if (!fits) return;
    for (const Pair p : pairs) add(task, asking_[p.a], p.b);
  };
  index_.find_overlaps(asking_fences_, walk_, keep);
  return fits;
}

template <class S>
bool Fences<S>::scan(const Task& task, std::uint32_t rank) {
  constexpr std::size_t batch = 256;
  for (std::size_t first = 0; first < fences_.size(); first += batch) {
    std::uint32_t overlapping[batch];
    const std::size_t size = std::min(batch, fences_.size() - first);
    const std::size_t count = find_overlapping(&fences_[first], size, fences_[rank], overlapping);
    for (std::size_t i = 0; i < count; ++i) {
      const auto other = static_cast<std::uint32_t>(first + overlapping[i]);
      if (task.proxies.is_valid(other)) add(task, rank, other);
    }
  }
  return kept() <= task.most;
}

/// The fences of these two overlap, the first has escaped.
template <class S>
void Fences<S>::add(const Task& task, std::uint32_t rank, std::uint32_t other) {
  // Two escaped proxies meet twice, and each one meets itself.
  if (other <= rank && has_escaped_[other]) return;
  const PairKey key = pair_key(rank, other);
  const bool goes_on = task.held.contains(key) && task.stays(key);
  if (!goes_on && !accepts(task.proxies.filter(rank), task.proxies.filter(other))) return;
  const bool is_sure = goes_on && has_cores_ && overlap_by_keys(cores_[rank], cores_[other]);
  (is_sure ? sure_ : candidates_).push_back(key << 1 | (goes_on ? 1 : 0));
}

#define INSTANTIATE(S)                                                                                              \
  template bool Fences<S>::renew(const ProxyTable<S>&, std::size_t, Detector&, FunctionRef<void(Span<const Pair>)>, \
                                 Stats&);                                                                           \
  template bool Fences<S>::search(const ProxyTable<S>&, const PairLists&, bool, std::vector<Pair>&,                 \
                                  std::vector<Pair>&);                                                              \
  template void Fences<S>::held_changed(Span<const PairKey>) noexcept
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
