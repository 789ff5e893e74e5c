// SPDX-License-Identifier: MIT
#include "world/fat_boxes/fat_boxes.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <boxstream/detail/float_environment.hpp>

#include "base/thresholds.hpp"
#include "world/fat_boxes/fat_boxes_simd.hpp"

namespace boxstream::detail {

namespace {

// Widest margin, in sides of the box: it gives eight times as many candidates as pairs.
constexpr double widest_margin = 0.5;

// More than any other way costs.
constexpr prices::Price never = ~prices::Price{0} / 2;

}  // namespace

template <class S>
void FatBoxes<S>::begin_update(const ProxyTable<S>& proxies, const UpdateThreads& threads) {
  const Span<const std::uint32_t> dirty = proxies.dirty();
  // Where few boxes move, other searches are cheaper, and motion need not be measured.
  if (!active_ && 8 * dirty.size() <= proxies.ranks()) return motion_.forget();
  const DefaultFloatEnvironment environment;
  ++update_;
  const bool follows = active_ && proxies.ranks() >= thresholds.least_followed;
  const std::uint32_t phase = (update_ - 1) % thresholds.measure_interval;
  // Drift needs the common step of every update.
  if (phase == 1 || (follows && motion_.has_common_step()))
    motion_.measure(proxies);
  else if (phase == 0)
    motion_.sample(proxies);
  if (!active_) return;
  grow_to(proxies.ranks());
  if (follows) drift(dirty.size());
  if (2 * dirty.size() > proxies.ranks())
    check_exits(proxies, threads);
  else
    for (const std::uint32_t rank : dirty) check_exit(proxies, rank);
}

/// Checks all boxes, dirty or not. Throws what the executor throws.
template <class S>
void FatBoxes<S>::check_exits(const ProxyTable<S>& proxies, const UpdateThreads& threads) {
  const Span<const Box> boxes = proxies.boxes();
  const auto find = [&](std::size_t first, std::size_t size, std::uint32_t* outside) {
    const DefaultFloatEnvironment environment;  // of each thread
    return find_outside(&fat_boxes_[first], cores(first), &boxes[first], size, drift(), outside);
  };
  selection_.find_and_visit(threads, boxes.size(), find,
                            [&](std::size_t rank) { check_exit(proxies, static_cast<std::uint32_t>(rank)); });
  if (!proxies.has_only_moved())
    for (std::uint32_t rank = 0; rank < boxes.size(); ++rank)
      if (proxies.flags(rank) > ProxyTable<S>::moved) check_exit(proxies, rank);
}

template <class S>
void FatBoxes<S>::check_exit(const ProxyTable<S>& proxies, std::uint32_t rank) noexcept {
  constexpr auto other = static_cast<std::uint8_t>(~ProxyTable<S>::moved);
  if ((proxies.flags(rank) & other) == 0 && contains(rank, proxies.box(rank))) return;
  if (has_exited_[rank] || (!proxies.is_valid(rank) && !has_valid_keys(fat_boxes_[rank]))) return;
  assert(exited_.size() < exited_.capacity());
  has_exited_[rank] = true;
  exited_.push_back(rank);
}

/// Moves all fat boxes by the common step, if nearly all boxes move: fat boxes drift away from boxes at rest.
template <class S>
void FatBoxes<S>::drift(std::size_t dirty) noexcept {
  if (!motion_.has_common_step() || 8 * dirty < 7 * fat_boxes_.size()) return;
  for (int d = 0; d < 3; ++d) drift_[d + 1] += motion_.common_step(d);
  drifts_ = true;
}

template <class S>
bool FatBoxes<S>::contains(std::uint32_t rank, const Box& box) const {
  assert(has_valid_keys(box));
  std::uint32_t outside[1];
  return find_outside(&fat_boxes_[rank], cores(rank), &box, 1, drift(), outside) == 0;
}

template <class S>
void FatBoxes<S>::grow_to(std::size_t ranks) {
  if (fat_boxes_.size() >= ranks) return;
  if (is_indexed_) index_.reserve_slots(ranks);
  fitted_in_.resize(ranks, 0);
  has_exited_.resize(ranks, false);
  cores_.resize(ranks, ProxyTable<S>::inert_box());
  reserve_more(fat_boxes_, ranks - fat_boxes_.size());
  exited_.reserve(fat_boxes_.capacity());
  selection_.reserve(fat_boxes_.capacity());
  fat_boxes_.resize(ranks, ProxyTable<S>::inert_box());  // the last one: the test above reads its size
}

/// Sets the fat box and the core of a rank. The fat box of an invalid box is invalid. `margin(axis, side)` is the
/// margin.
template <class S>
template <class Margin>
void FatBoxes<S>::fit(std::uint32_t rank, const Box& box, Margin&& margin) {
  fitted_in_[rank] = update_;
  Box& fat_box = fat_boxes_[rank];
  Box& core = cores_[rank];
  if (!is_moderate(box)) {
    core = ProxyTable<S>::inert_box();
    fat_box = has_valid_keys(box) ? box : ProxyTable<S>::inert_box();
    return;
  }
  for (int d = 0; d < 3; ++d) {
    // More than the rounding error of the sums: where fat boxes drift, a box at the edge counts as outside.
    const S slack =
        std::numeric_limits<S>::epsilon() * (std::abs(box.min[d]) + std::abs(box.max[d]) + std::abs(drift_on(d)));
    const S out = margin(d, box.max[d] - box.min[d]) + slack;
    fat_box.min[d] = box.min[d] - drift_on(d) - out;
    fat_box.max[d] = box.max[d] - drift_on(d) + out;
    if (!has_cores_) continue;
    core.min[d] = box.min[d] - drift_on(d) + out;
    core.max[d] = box.max[d] - drift_on(d) - out;
  }
}

/// Fits a box that has left its fat box. The margin is wide enough for a while if the box keeps its mean speed since
/// the last fit.
template <class S>
void FatBoxes<S>::refit(std::uint32_t rank, const Box& box) {
  const Box last = fat_boxes_[rank];
  // With cores, wide margins cost little.
  const S ahead =
      static_cast<S>(has_cores_ ? 2 * planned_ : planned_) / static_cast<S>(std::max(update_ - fitted_in_[rank], 1u));
  fit(rank, box, [&](int d, S side) {
    const S went = std::abs((box.min[d] + box.max[d] - last.min[d] - last.max[d]) / 2 - drift_on(d));
    const S margin = margins_.of(d, side);
    return ahead * went > margin ? std::max(margin, std::min(ahead * went, static_cast<S>(widest_margin) * side))
                                 : margin;
  });
  if (is_indexed_) index_.mark(rank);
  constexpr S inf = std::numeric_limits<S>::infinity();
  if (!drifts_ || !has_valid_keys(box) || contains(rank, box)) return;
  fat_boxes_[rank] = {{-inf, -inf, -inf}, {inf, inf, inf}};
  cores_[rank] = ProxyTable<S>::inert_box();
}

template <class S>
void FatBoxes<S>::fit_all(const ProxyTable<S>& proxies, std::size_t pairs) {
  std::fill_n(drift_, std::size(drift_), S{0});
  drifts_ = false;
  margins_ = motion_.after(planned_);
  const std::uint64_t sure = sure_after(planned_, pairs);
  has_cores_ = sure != 0 && 4 * sure >= pairs;
  // A box at rest is likely to stay at rest: no margin.
  for (std::uint32_t rank = 0; rank < proxies.ranks(); ++rank)
    fit(rank, proxies.box(rank), [&](int d, S side) { return proxies.is_dirty(rank) ? margins_.of(d, side) : S{0}; });
}

template <class S>
prices::Price FatBoxes<S>::planned_price(const ProxyTable<S>& proxies, std::size_t pairs) const {
  if (proxies.ranks() > most_ranks) return never;
  const DefaultFloatEnvironment environment;  // the same price in every host
  return best_plan(proxies.dirty().size(), proxies.ranks(), pairs).price;
}

/// Expected number of candidates with margins for `updates` updates.
template <class S>
std::uint64_t FatBoxes<S>::candidates_after(unsigned updates, std::size_t pairs) const {
  double wider = 1;
  for (int d = 0; d < 3; ++d)
    if (motion_.side(d) > 0)
      wider *= 1 + 2 * static_cast<double>(updates) *
                       static_cast<double>(motion_.after(1).of(d, motion_.side(d)) / motion_.side(d));
  return static_cast<std::uint64_t>(wider * static_cast<double>(pairs));
}

/// Expected number of sure pairs among them.
template <class S>
std::uint64_t FatBoxes<S>::sure_after(unsigned updates, std::size_t pairs) const {
  if (fat_boxes_.size() >= thresholds.in_near_caches) return 0;  // reading cores takes longer than testing the pairs
  double share = 1;
  for (int d = 0; d < 3; ++d)
    if (motion_.side(d) > 0)
      share *= std::max(0.0, 1 - 2 * static_cast<double>(updates) *
                                     static_cast<double>(motion_.after(1).of(d, motion_.side(d)) / motion_.side(d)));
  return static_cast<std::uint64_t>(share * static_cast<double>(pairs));
}

/// True if margins for `updates` updates are not too wide.
template <class S>
bool FatBoxes<S>::margins_fit(unsigned updates) const {
  for (int d = 0; d < 3; ++d)
    if (static_cast<S>(updates) * motion_.after(1).of(d, motion_.side(d)) >
        static_cast<S>(widest_margin) * motion_.side(d))
      return false;
  return true;
}

/// The cheapest number of updates to make margins for. The update after them is a rebuild.
template <class S>
typename FatBoxes<S>::Plan FatBoxes<S>::best_plan(std::size_t dirty, std::size_t ranks, std::size_t pairs) const {
  Plan best{1, never};
  if (!motion_.is_known()) return best;
  for (unsigned updates = 1; updates <= thresholds.most_planned; updates += 1 + updates / 4) {
    if (!margins_fit(updates)) break;
    const std::uint64_t candidates = candidates_after(updates, pairs);
    if (candidates > most_candidates(ranks, pairs)) break;
    const prices::Price price =
        (prices::rebuild(ranks, pairs, candidates) +
         updates * prices::pass(dirty, candidates - std::min(candidates, sure_after(updates, pairs)))) /
        (updates + 1);
    if (price < best.price) best = {updates, price};
  }
  return best;
}

template <class S>
void FatBoxes<S>::drop() noexcept {
  active_ = false;
  index_.clear();
  is_indexed_ = false;
  candidates_.clear();
  sure_.clear();
  changed_.clear();
  forget_exits();
  motion_.forget();
}

/// All marks, not those of the list alone: an exception may have left others.
template <class S>
void FatBoxes<S>::forget_exits() noexcept {
  std::fill(has_exited_.begin(), has_exited_.end(), std::uint8_t{0});
  exited_.clear();
}

template <class S>
void FatBoxes<S>::remap(Span<const std::uint32_t> new_rank) noexcept {
  constexpr std::uint32_t none = ProxyTable<S>::none;
  motion_.forget();
  std::size_t count = 0;
  for (std::size_t from = 0; from < fat_boxes_.size(); ++from) {
    if (new_rank[from] == none) continue;
    fat_boxes_[count] = fat_boxes_[from];
    cores_[count] = cores_[from];
    fitted_in_[count] = fitted_in_[from];
    has_exited_[count] = has_exited_[from];
    ++count;
  }
  fat_boxes_.resize(count);
  cores_.resize(count);
  fitted_in_.resize(count);
  has_exited_.resize(count);
  std::size_t kept = 0;
  for (const std::uint32_t rank : exited_)
    if (new_rank[rank] != none) exited_[kept++] = new_rank[rank];
  exited_.resize(kept);
  for (std::vector<Candidate>* candidates : {&candidates_, &sure_}) {
    kept = 0;
    for (const Candidate candidate : *candidates) {
      const std::uint32_t a = new_rank[first_of(key_of(candidate))], b = new_rank[second_of(key_of(candidate))];
      if (a != none && b != none) (*candidates)[kept++] = pair_key(a, b) << 1 | (candidate & 1);
    }
    candidates->resize(kept);
  }
  kept = 0;
  for (const PairKey key : changed_) {
    const std::uint32_t a = new_rank[first_of(key)], b = new_rank[second_of(key)];
    if (a != none && b != none) changed_[kept++] = pair_key(a, b);
  }
  changed_.resize(kept);
  index_.clear();
  is_indexed_ = false;
}

template <class S>
void FatBoxes<S>::clear() noexcept {
  drop();
  motion_ = {};
  planned_ = 1;
  margins_ = {};
  fat_boxes_.clear();
  cores_.clear();
  fitted_in_.clear();
  has_exited_.clear();
  update_ = 0;
}

template <class S>
void FatBoxes<S>::validate(const ProxyTable<S>& proxies, const HeldPairs& held) const {
  if (!active_) return;
  const DefaultFloatEnvironment environment;
  const auto check = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  std::vector<PairKey> changed = changed_;
  std::sort(changed.begin(), changed.end());
  const auto has_changed = [&](PairKey key) { return std::binary_search(changed.begin(), changed.end(), key); };
  std::vector<PairKey> keys;
  for (const std::vector<Candidate>* candidates : {&candidates_, &sure_})
    for (const Candidate candidate : *candidates) {
      keys.push_back(key_of(candidate));
      check(is_held(candidate) == held.contains(keys.back()) || has_changed(keys.back()),
            "candidates: a wrong held bit");
    }
  const auto may_separate = [&](std::uint32_t rank) { return has_exited_[rank] || proxies.is_dirty(rank); };
  for (const Candidate candidate : sure_) {
    const std::uint32_t a = first_of(key_of(candidate)), b = second_of(key_of(candidate));
    check(is_held(candidate) && (may_separate(a) || may_separate(b) || proxies.touching(a, b)),
          "candidates: a sure pair does not overlap");
  }
  std::sort(keys.begin(), keys.end());
  check(std::adjacent_find(keys.begin(), keys.end()) == keys.end(), "candidates: a duplicate");
  held.for_each([&](PairKey key) {
    check(std::binary_search(keys.begin(), keys.end(), key) || has_changed(key), "candidates: a held pair is missing");
    return true;
  });
  for (std::uint32_t rank = 0; rank < fat_boxes_.size(); ++rank)
    check(has_exited_[rank] || proxies.is_dirty(rank) || !proxies.is_valid(rank) || contains(rank, proxies.box(rank)),
          "candidates: an exit from a fat box was missed");
  Detector detector;
  const auto is_candidate = [&](Span<const Pair> pairs) {
    for (const Pair pair : pairs) {
      const PairKey key = pair_key(pair.a, pair.b);
      check(may_separate(pair.a) || may_separate(pair.b) || has_changed(key) ||
                !accepts(proxies.filter(pair.a), proxies.filter(pair.b)) ||
                std::binary_search(keys.begin(), keys.end(), key),
            "candidates: a pair of overlapping fat boxes is missing");
    }
    return true;
  };
  detector.stream_pairs(Span<const Box>(fat_boxes_.data(), fat_boxes_.size()), is_candidate);
}

// Members are instantiated one by one: two files define them.
#define INSTANTIATE(S)                                                                                     \
  template void FatBoxes<S>::begin_update(const ProxyTable<S>&, const UpdateThreads&);                     \
  template void FatBoxes<S>::grow_to(std::size_t);                                                         \
  template typename FatBoxes<S>::Plan FatBoxes<S>::best_plan(std::size_t, std::size_t, std::size_t) const; \
  template void FatBoxes<S>::refit(std::uint32_t, const Box&);                                             \
  template void FatBoxes<S>::fit_all(const ProxyTable<S>&, std::size_t);                                   \
  template prices::Price FatBoxes<S>::planned_price(const ProxyTable<S>&, std::size_t) const;              \
  template void FatBoxes<S>::drop() noexcept;                                                              \
  template void FatBoxes<S>::forget_exits() noexcept;                                                      \
  template void FatBoxes<S>::remap(Span<const std::uint32_t>) noexcept;                                    \
  template void FatBoxes<S>::clear() noexcept;                                                             \
  template void FatBoxes<S>::validate(const ProxyTable<S>&, const HeldPairs&) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
