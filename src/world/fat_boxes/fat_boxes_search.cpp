// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cassert>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "world/fat_boxes/fat_boxes.hpp"
#include "world/fat_boxes/fat_boxes_simd.hpp"

namespace boxstream::detail {

namespace {

Pair pair_of(PairKey key) {
  return {first_of(key), second_of(key)};
}

template <class S>
CandidateCounts candidates_among(const BasicAabb<S>* boxes, const BasicAabb<S>* cores, Span<const Pair> pairs,
                                 std::uint64_t* recheck, std::uint64_t* sure, Pair* overlapping) {
  const DefaultFloatEnvironment environment;
  return make_candidates(boxes, cores, pairs.data(), pairs.size(), recheck, sure, overlapping);
}

/// Adds `count` elements, and returns a pointer to the first.
template <class T>
T* add_elements(std::vector<T>& all, std::size_t count) {
  const std::size_t known = all.size();
  reserve_more(all, count);
  all.resize(known + count);
  return all.data() + known;
}

}  // namespace

template <class S>
bool FatBoxes<S>::rebuild(const ProxyTable<S>& proxies, std::size_t pairs, Detector& detector,
                          FunctionRef<void(Span<const Pair>)> sink, Stats& stats) {
  grow_to(proxies.ranks());
  {
    const DefaultFloatEnvironment environment;
    planned_ = best_plan(proxies.dirty().size(), proxies.ranks(), pairs).updates;
    fit_all(proxies, pairs);
  }
  candidates_.clear();
  sure_.clear();
  changed_.clear();
  const std::size_t most = most_candidates(proxies.ranks(), pairs);
  const Span<const Box> boxes = proxies.boxes();
  bool fits = true;
  const auto keep = [&](Span<const Pair> found) {
    constexpr std::size_t batch = 2 * thresholds.portion;
    fits = kept() + found.size() <= most;
    for (std::size_t first = 0; fits && first < found.size(); first += batch) {
      const Span<const Pair> some = found.subspan(first, std::min(batch, found.size() - first));
      const std::size_t known = candidates_.size(), known_sure = sure_.size();
      Candidate* const recheck = add_elements(candidates_, some.size());
      Candidate* const sure = add_elements(sure_, some.size());
      Pair overlapping[batch];
      const CandidateCounts counts = candidates_among(boxes.data(), cores(0), some, recheck, sure, overlapping);
      candidates_.resize(known + counts.recheck);
      sure_.resize(known_sure + counts.sure);
      sink({overlapping, counts.overlapping});
    }
    return fits;
  };
  stats = detector.stream_pairs(Span<const Box>(fat_boxes_.data(), proxies.ranks()), keep, proxies.batch_filters());
  if (!fits) return false;
  forget_exits();
  index_.clear();
  is_indexed_ = false;
  return active_ = true;
}

template <class S>
bool FatBoxes<S>::search(const ProxyTable<S>& proxies, const PairLists& held, bool sticky_filters,
                         const UpdateThreads& threads, std::vector<Pair>& begun, std::vector<Pair>& ended) {
  assert(active_);
  begun.clear();
  ended.clear();
  const std::size_t most = most_candidates(proxies.ranks(), static_cast<std::size_t>(held.size()));
  const Task task{proxies, held, sticky_filters, threads, most, begun, ended};
  correct_changed(task);
  if (!exited_.empty() && !reinsert_exited(task)) return false;
  pass(task);
  return true;
}

template <class S>
bool FatBoxes<S>::Task::stays(PairKey key) const {
  const std::uint32_t a = first_of(key), b = second_of(key);
  return proxies.touching(a, b) && (sticky_filters || accepts(proxies.filter(a), proxies.filter(b)));
}

/// Filters are tested again: with sticky filters a candidate may have been held that they refuse by now.
template <class S>
bool FatBoxes<S>::Task::may_begin(Pair pair) const {
  return (proxies.is_dirty(pair.a) || proxies.is_dirty(pair.b)) &&
         accepts(proxies.filter(pair.a), proxies.filter(pair.b));
}

/// Nearly all held bits agree with the boxes. A candidate that overlaps and is not held was refused by a filter, unless
/// one of its proxies is dirty.
template <class S>
void FatBoxes<S>::pass(const Task& task) {
  const Span<const Box> boxes = task.proxies.boxes();
  const auto find = [&](std::size_t first, std::size_t size, std::uint32_t* differ) {
    const DefaultFloatEnvironment environment;  // of each thread
    return find_changed(boxes.data(), candidates_.data() + first, size, differ);
  };
  selection_.reserve(candidates_.size());
  selection_.find_and_visit(task.threads, candidates_.size(), find, [&](std::size_t place) {
    Candidate& candidate = candidates_[place];
    const Pair pair = pair_of(key_of(candidate));
    if (!is_held(candidate) && !task.may_begin(pair)) return;
    (is_held(candidate) ? task.ended : task.begun).push_back(pair);
    candidate ^= 1;
  });
}

template <class S>
void FatBoxes<S>::held_changed(Span<const PairKey> keys) noexcept {
  if (!active_ || keys.empty()) return;
  // The list would grow without bound while other searches are cheaper.
  if (changed_.size() + keys.size() > candidates_.size() + thresholds.changed_of_proxy * fat_boxes_.size())
    return drop();
  try {
    changed_.insert(changed_.end(), keys.begin(), keys.end());
  } catch (...) {
    drop();
  }
}

/// True if fat boxes and filters allow the pair: then it has to be a candidate.
template <class S>
bool FatBoxes<S>::may_overlap(const ProxyTable<S>& proxies, std::uint32_t a, std::uint32_t b) const {
  return has_valid_keys(fat_boxes_[a]) && has_valid_keys(fat_boxes_[b]) &&
         overlap_by_keys(fat_boxes_[a], fat_boxes_[b]) && accepts(proxies.filter(a), proxies.filter(b));
}

/// Makes candidates of held pairs that are not, even if their fat boxes do not overlap any more. A pair that ends
/// remains a candidate while its fat boxes overlap.
template <class S>
void FatBoxes<S>::correct_changed(const Task& task) {
  if (changed_.empty()) return;
  std::sort(changed_.begin(), changed_.end());
  changed_.erase(std::unique(changed_.begin(), changed_.end()), changed_.end());
  constexpr std::uint8_t marked = 2;
  assert(std::none_of(has_exited_.begin(), has_exited_.end(), [](std::uint8_t exited) { return exited > 1; }));
  for (const PairKey key : changed_) has_exited_[first_of(key)] |= marked;
  for (std::vector<Candidate>* candidates : {&candidates_, &sure_})
    std::erase_if(*candidates, [&](Candidate candidate) {
      const PairKey key = key_of(candidate);
      return (has_exited_[first_of(key)] & marked) != 0 && std::binary_search(changed_.begin(), changed_.end(), key);
    });
  for (const PairKey key : changed_) {
    has_exited_[first_of(key)] &= static_cast<std::uint8_t>(~marked);
    const std::uint32_t a = first_of(key), b = second_of(key);
    const bool is_held = task.held.contains(key), stays_held = is_held && task.stays(key);
    if (is_held && !stays_held) task.ended.push_back(pair_of(key));
    if (stays_held || may_overlap(task.proxies, a, b)) candidates_.push_back(key << 1 | (stays_held ? 1 : 0));
  }
  changed_.clear();
}

template <class S>
bool FatBoxes<S>::reinsert_exited(const Task& task) {
  const DefaultFloatEnvironment environment;
  drop_candidates_of_exited(task, candidates_);
  drop_candidates_of_exited(task, sure_);
  for (const std::uint32_t rank : exited_) refit(rank, task.proxies.box(rank));
  if (!find_candidates_of_exited(task)) return false;
  for (const std::uint32_t rank : exited_) has_exited_[rank] = false;
  exited_.clear();
  return true;
}

/// Drops all their candidates; those that remain valid are found again.
template <class S>
void FatBoxes<S>::drop_candidates_of_exited(const Task& task, std::vector<Candidate>& candidates) {
  std::erase_if(candidates, [&](Candidate candidate) {
    const PairKey key = key_of(candidate);
    if ((has_exited_[first_of(key)] | has_exited_[second_of(key)]) == 0) return false;
    if (is_held(candidate) && !task.stays(key)) task.ended.push_back(pair_of(key));
    return true;
  });
}

/// Few exits scan all fat boxes, which needs no index; many probe the index.
template <class S>
bool FatBoxes<S>::find_candidates_of_exited(const Task& task) {
  queries_.clear();
  for (const std::uint32_t rank : exited_)
    if (task.proxies.is_valid(rank)) queries_.push_back(rank);
  if (uses_scans()) {
    for (const std::uint32_t rank : queries_)
      if (!scan(task, rank)) return false;
    return true;
  }
  if (!is_indexed_) {
    index_.reserve_slots(fat_boxes_.size());
    for (std::uint32_t rank = 0; rank < fat_boxes_.size(); ++rank) index_.mark(rank);
    is_indexed_ = true;
  }
  index_.refresh([this](std::uint32_t rank) { return fat_boxes_[rank]; });
  query_boxes_.clear();
  for (const std::uint32_t rank : queries_) query_boxes_.push_back(fat_boxes_[rank]);
  bool fits = true;
  const auto keep = [&](Span<const Pair> pairs) {
    fits = fits && kept() <= task.most;
    if (!fits) return;
    for (const Pair p : pairs) add(task, queries_[p.a], p.b);
  };
  index_.find_overlaps(query_boxes_, walk_, keep);
  return fits;
}

template <class S>
bool FatBoxes<S>::scan(const Task& task, std::uint32_t rank) {
  constexpr std::size_t batch = thresholds.portion;
  for (std::size_t first = 0; first < fat_boxes_.size(); first += batch) {
    std::uint32_t overlapping[batch];
    const std::size_t size = std::min(batch, fat_boxes_.size() - first);
    const std::size_t count = find_overlapping(&fat_boxes_[first], size, fat_boxes_[rank], overlapping);
    for (std::size_t i = 0; i < count; ++i) {
      const auto other = static_cast<std::uint32_t>(first + overlapping[i]);
      if (task.proxies.is_valid(other)) add(task, rank, other);
    }
  }
  return kept() <= task.most;
}

/// Adds a pair of an exited one whose fat boxes overlap.
template <class S>
void FatBoxes<S>::add(const Task& task, std::uint32_t rank, std::uint32_t other) {
  assert(has_exited_[rank]);
  // Two exited proxies find each other twice, and each finds itself.
  if (other <= rank && has_exited_[other]) return;
  const PairKey key = pair_key(rank, other);
  const bool stays_held = task.held.contains(key) && task.stays(key);
  if (!stays_held && !accepts(task.proxies.filter(rank), task.proxies.filter(other))) return;
  const bool is_sure = stays_held && has_cores_ && overlap_by_keys(cores_[rank], cores_[other]);
  (is_sure ? sure_ : candidates_).push_back(key << 1 | (stays_held ? 1 : 0));
}

#define INSTANTIATE(S)                                                                                  \
  template bool FatBoxes<S>::rebuild(const ProxyTable<S>&, std::size_t, Detector&,                      \
                                     FunctionRef<void(Span<const Pair>)>, Stats&);                      \
  template bool FatBoxes<S>::search(const ProxyTable<S>&, const PairLists&, bool, const UpdateThreads&, \
                                    std::vector<Pair>&, std::vector<Pair>&);                            \
  template void FatBoxes<S>::held_changed(Span<const PairKey>) noexcept
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
