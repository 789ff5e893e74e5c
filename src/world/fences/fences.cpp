// SPDX-License-Identifier: MIT
#include "world/fences/fences.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>

#include <boxstream/detail/float_environment.hpp>

#include "world/fences/fences_simd.hpp"

namespace boxstream::detail {

namespace {

// Fences are planned for at most so many updates.
constexpr unsigned most_planned = 64;

// No skin is wider than so many sides: by then there are eight times as many candidates as pairs.
constexpr double widest_skin = 0.5;

// How boxes move is looked at in one of so many updates.
constexpr std::uint32_t look_interval = 8;

// With fewer boxes than this, to follow what they do in common costs more than it can save.
constexpr std::size_t least_followed = 128;

// Boxes that the nearest caches hold.
constexpr std::size_t in_near_caches = 32768;

}  // namespace

template <class S>
void Fences<S>::notice(const ProxyTable<S>& proxies) {
  const std::vector<std::uint32_t>& touched = proxies.touched();
  // Where few move, there are cheaper ways to search, and no need to know.
  if (!stand_ && 8 * touched.size() <= proxies.ranks()) return motion_.forget();
  const DefaultFloatEnvironment environment;
  ++update_;
  const bool follows = stand_ && proxies.ranks() >= least_followed;
  const std::uint32_t turn = (update_ - 1) % look_interval;
  // Of what all have in common no step may be missed.
  if (turn == 1 || (follows && motion_.has_common()))
    motion_.look(proxies);
  else if (turn == 0)
    motion_.sample(proxies);
  if (!stand_) return;
  grow_to(proxies.ranks());
  if (follows) drift(touched.size());
  if (2 * touched.size() > proxies.ranks())
    notice_all(proxies);
  else
    for (const std::uint32_t rank : touched) notice(proxies, rank);
}

/// Whatever was touched.
template <class S>
void Fences<S>::notice_all(const ProxyTable<S>& proxies) noexcept {
  constexpr std::size_t batch = 256;
  const Span<const Box> boxes = proxies.boxes();
  for (std::size_t first = 0; first < boxes.size(); first += batch) {
    const std::size_t size = std::min(batch, boxes.size() - first);
    std::uint32_t outside[batch];
    const std::size_t count = find_outside(&fences_[first], cores(first), &boxes[first], size, drift(), outside);
    for (std::size_t i = 0; i < count; ++i) notice(proxies, static_cast<std::uint32_t>(first + outside[i]));
  }
  if (!proxies.has_only_moved())
    for (std::uint32_t rank = 0; rank < boxes.size(); ++rank)
      if (proxies.flags(rank) > ProxyTable<S>::moved) notice(proxies, rank);
}

template <class S>
void Fences<S>::notice(const ProxyTable<S>& proxies, std::uint32_t rank) noexcept {
  constexpr auto other = static_cast<std::uint8_t>(~ProxyTable<S>::moved);
  if ((proxies.flags(rank) & other) == 0 && contains(rank, proxies.box(rank))) return;
  if (has_escaped_[rank] || (!proxies.is_valid(rank) && !has_valid_keys(fences_[rank]))) return;
  has_escaped_[rank] = true;
  escaped_.push_back(rank);
}

/// Moves all fences on. Only where nearly all boxes do so: others would be left behind by their fences.
template <class S>
void Fences<S>::drift(std::size_t touched) noexcept {
  if (!motion_.has_common() || 8 * touched < 7 * fences_.size()) return;
  for (int d = 0; d < 3; ++d) drift_[d + 1] += motion_.common(d);
  drifts_ = true;
}

/// For a valid box.
template <class S>
bool Fences<S>::contains(std::uint32_t rank, const Box& box) const {
  std::uint32_t outside[1];
  return find_outside(&fences_[rank], cores(rank), &box, 1, drift(), outside) == 0;
}

template <class S>
void Fences<S>::grow_to(std::size_t ranks) {
  if (fences_.size() >= ranks) return;
  if (is_indexed_) index_.reserve_slots(ranks);
  raised_.resize(ranks, 0);
  has_escaped_.resize(ranks, false);
  cores_.resize(ranks, ProxyTable<S>::inert_box());
  reserve_more(fences_, ranks - fences_.size());
  escaped_.reserve(fences_.capacity());
  fences_.resize(ranks, ProxyTable<S>::inert_box());  // the last one, because the others go by its size
}

/// `box` may be invalid; then its fence is as well. `skin(axis, side)` is how wide.
template <class S>
template <class Skin>
void Fences<S>::raise(std::uint32_t rank, const Box& box, Skin&& skin) {
  raised_[rank] = update_;
  Box& fence = fences_[rank];
  Box& core = cores_[rank];
  if (!is_moderate(box)) {
    core = ProxyTable<S>::inert_box();
    fence = has_valid_keys(box) ? box : ProxyTable<S>::inert_box();
    return;
  }
  for (int d = 0; d < 3; ++d) {
    // What sums are rounded by, and more: where fences drift, boxes at their edge would be outside.
    const S slip =
        std::numeric_limits<S>::epsilon() * (std::abs(box.min[d]) + std::abs(box.max[d]) + std::abs(drift_on(d)));
    const S out = skin(d, box.max[d] - box.min[d]) + slip;
    fence.min[d] = box.min[d] - drift_on(d) - out;
    fence.max[d] = box.max[d] - drift_on(d) + out;
    if (!has_cores_) continue;
    core.min[d] = box.min[d] - drift_on(d) + out;
    core.max[d] = box.max[d] - drift_on(d) - out;
  }
}

/// For one that has escaped by itself: wide enough for a while if it goes on as it went since the last time.
template <class S>
void Fences<S>::raise_again(std::uint32_t rank, const Box& box) {
  const Box last = fences_[rank];
  // With cores, wide ones cost little.
  const S ahead =
      static_cast<S>(has_cores_ ? 2 * planned_ : planned_) / static_cast<S>(std::max(update_ - raised_[rank], 1u));
  raise(rank, box, [&](int d, S side) {
    const S went = std::abs((box.min[d] + box.max[d] - last.min[d] - last.max[d]) / 2 - drift_on(d));
    const S skin = skins_.of(d, side);
    return ahead * went > skin ? std::max(skin, std::min(ahead * went, static_cast<S>(widest_skin) * side)) : skin;
  });
  if (is_indexed_) index_.mark(rank);
  constexpr S inf = std::numeric_limits<S>::infinity();
  if (!drifts_ || !has_valid_keys(box) || contains(rank, box)) return;
  fences_[rank] = {{-inf, -inf, -inf}, {inf, inf, inf}};
  cores_[rank] = ProxyTable<S>::inert_box();
}

template <class S>
void Fences<S>::raise_all(const ProxyTable<S>& proxies, std::size_t pairs) {
  std::fill_n(drift_, std::size(drift_), S{0});
  drifts_ = false;
  skins_ = motion_.after(planned_);
  const std::size_t sure = sure_after(planned_, pairs);
  has_cores_ = sure != 0 && 4 * sure >= pairs;
  // What rests is likely to go on.
  for (std::uint32_t rank = 0; rank < proxies.ranks(); ++rank)
    raise(rank, proxies.box(rank), [&](int d, S side) { return proxies.is_touched(rank) ? skins_.of(d, side) : S{0}; });
}

/// In the units of OverlapSearch::choose: looking at a moved box or at a candidate costs a tenth, or a sixth where the
/// boxes are beyond the nearest caches.
template <class S>
std::size_t Fences<S>::walk_price(std::size_t touched, std::size_t candidates) const {
  return (touched + candidates) / (touched < in_near_caches ? 10 : 6);
}

/// For a proxy that has escaped all fences are looked at in a fortieth of a batch; or, with the index kept fit and its
/// candidates found, it costs 0.7, 1 and 2 microseconds at 10^3, 10^4 and 10^5 boxes. And all candidates are looked at
/// once more.
template <class S>
std::size_t Fences<S>::escape_price() const {
  if (escaped_.empty()) return 0;
  const std::size_t ranks = fences_.size(), again = kept() / 10;
  if (scans()) return ranks / 40 * escaped_.size() + again;
  return (is_indexed_ ? 0 : 3 * ranks) + 3 * static_cast<std::size_t>(std::bit_width(ranks)) * escaped_.size() + again;
}

template <class S>
std::size_t Fences<S>::renewal_price(std::size_t ranks, std::size_t pairs, std::size_t candidates) const {
  return ranks + ranks / 4 + pairs / 2 + candidates / 4;
}

template <class S>
std::size_t Fences<S>::price(const ProxyTable<S>& proxies, std::size_t pairs) const {
  const DefaultFloatEnvironment environment;
  const std::size_t touched = proxies.touched().size();
  if (stand_) {
    if (are_worn(proxies, pairs)) return renewal_price(proxies.ranks(), pairs, kept());
    return walk_price(touched, candidates_.size()) + escape_price();
  }
  return static_cast<std::size_t>(best_plan(touched, proxies.ranks(), pairs).price);
}

/// How many there are likely to be if skins are for so many updates.
template <class S>
std::size_t Fences<S>::candidates_after(unsigned updates, std::size_t pairs) const {
  double wider = 1;
  for (int d = 0; d < 3; ++d)
    if (motion_.side(d) > 0)
      wider *= 1 + 2 * static_cast<double>(updates) *
                       static_cast<double>(motion_.after(1).of(d, motion_.side(d)) / motion_.side(d));
  return static_cast<std::size_t>(wider * static_cast<double>(pairs));
}

/// How many of them are likely to be sure: pairs usually overlap by an eighth of a side.
template <class S>
std::size_t Fences<S>::sure_after(unsigned updates, std::size_t pairs) const {
  if (fences_.size() >= in_near_caches) return 0;  // to read cores takes longer than to look at the pairs
  double share = 1;
  for (int d = 0; d < 3; ++d)
    if (motion_.side(d) > 0)
      share *= std::max(0.0, 1 - 2 * static_cast<double>(updates) *
                                     static_cast<double>(motion_.after(1).of(d, motion_.side(d)) / motion_.side(d)));
  return static_cast<std::size_t>(share * static_cast<double>(pairs));
}

/// True if the skins for so many updates are not too wide.
template <class S>
bool Fences<S>::fits_skins(unsigned updates) const {
  for (int d = 0; d < 3; ++d)
    if (static_cast<S>(updates) * motion_.after(1).of(d, motion_.side(d)) >
        static_cast<S>(widest_skin) * motion_.side(d))
      return false;
  return true;
}

/// For how many updates skins had best be. They are renewed in the one after.
template <class S>
typename Fences<S>::Plan Fences<S>::best_plan(std::size_t touched, std::size_t ranks, std::size_t pairs) const {
  Plan best{1, 1e18};
  if (!motion_.is_known()) return best;
  for (unsigned updates = 1; updates <= most_planned; updates += 1 + updates / 4) {
    if (!fits_skins(updates)) break;
    const std::size_t candidates = candidates_after(updates, pairs);
    if (candidates > most_candidates(ranks, pairs)) break;
    const std::size_t price =
        (renewal_price(ranks, pairs, candidates) +
         updates * walk_price(touched, candidates - std::min(candidates, sure_after(updates, pairs)))) /
        (updates + 1);
    if (static_cast<double>(price) < best.price) best = {updates, static_cast<double>(price)};
  }
  return best;
}

/// Worn are fences that so many leave at once that the average cost of an update would go up; or one after the other,
/// when that will have cost as much as to renew them all.
template <class S>
bool Fences<S>::are_worn(const ProxyTable<S>& proxies, std::size_t pairs) const {
  if (!stand_) return true;
  const std::size_t escape = escape_price(), renewal = renewal_price(proxies.ranks(), pairs, kept());
  const std::size_t price = walk_price(proxies.touched().size(), candidates_.size()) + escape;
  return spent_on_escapes_ + escape > renewal || (4 * escape > renewal && price * updates_ > spent_);
}

template <class S>
void Fences<S>::drop() noexcept {
  stand_ = false;
  index_.clear();
  is_indexed_ = false;
  candidates_.clear();
  sure_.clear();
  changed_.clear();
  for (const std::uint32_t rank : escaped_) has_escaped_[rank] = false;
  escaped_.clear();
  motion_.forget();
}

template <class S>
void Fences<S>::remap(Span<const std::uint32_t> new_rank) noexcept {
  constexpr std::uint32_t none = ProxyTable<S>::none;
  motion_.forget();
  std::size_t count = 0;
  for (std::size_t from = 0; from < fences_.size(); ++from) {
    if (new_rank[from] == none) continue;
    fences_[count] = fences_[from];
    cores_[count] = cores_[from];
    raised_[count] = raised_[from];
    has_escaped_[count] = has_escaped_[from];
    ++count;
  }
  fences_.resize(count);
  cores_.resize(count);
  raised_.resize(count);
  has_escaped_.resize(count);
  std::size_t kept = 0;
  for (const std::uint32_t rank : escaped_)
    if (new_rank[rank] != none) escaped_[kept++] = new_rank[rank];
  escaped_.resize(kept);
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
void Fences<S>::clear() noexcept {
  drop();
  fences_.clear();
  cores_.clear();
  raised_.clear();
  has_escaped_.clear();
  update_ = 0;
}

template <class S>
void Fences<S>::validate(const ProxyTable<S>& proxies, const HeldPairs& held) const {
  if (!stand_) return;
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
            "fences: a candidate is wrong about being held");
    }
  const auto may_part = [&](std::uint32_t rank) { return has_escaped_[rank] || proxies.is_touched(rank); };
  for (const Candidate candidate : sure_) {
    const std::uint32_t a = first_of(key_of(candidate)), b = second_of(key_of(candidate));
    check(is_held(candidate) && (may_part(a) || may_part(b) || proxies.touching(a, b)),
          "fences: a pair that was sure has parted");
  }
  std::sort(keys.begin(), keys.end());
  check(std::adjacent_find(keys.begin(), keys.end()) == keys.end(), "fences: a candidate is there twice");
  held.for_each([&](PairKey key) {
    check(std::binary_search(keys.begin(), keys.end(), key) || has_changed(key), "fences: a held pair is no candidate");
    return true;
  });
  for (std::uint32_t rank = 0; rank < fences_.size(); ++rank)
    check(
        has_escaped_[rank] || proxies.is_touched(rank) || !proxies.is_valid(rank) || contains(rank, proxies.box(rank)),
        "fences: a box has left its fence unnoticed");
}

// Members are instantiated one by one, because their definitions are spread over two files.
#define INSTANTIATE(S)                                                                                 \
  template void Fences<S>::notice(const ProxyTable<S>&);                                               \
  template void Fences<S>::grow_to(std::size_t);                                                       \
  template typename Fences<S>::Plan Fences<S>::best_plan(std::size_t, std::size_t, std::size_t) const; \
  template void Fences<S>::raise_again(std::uint32_t, const Box&);                                     \
  template void Fences<S>::raise_all(const ProxyTable<S>&, std::size_t);                               \
  template std::size_t Fences<S>::walk_price(std::size_t, std::size_t) const;                          \
  template std::size_t Fences<S>::escape_price() const;                                                \
  template std::size_t Fences<S>::renewal_price(std::size_t, std::size_t, std::size_t) const;          \
  template std::size_t Fences<S>::price(const ProxyTable<S>&, std::size_t) const;                      \
  template bool Fences<S>::are_worn(const ProxyTable<S>&, std::size_t) const;                          \
  template void Fences<S>::drop() noexcept;                                                            \
  template void Fences<S>::remap(Span<const std::uint32_t>) noexcept;                                  \
  template void Fences<S>::clear() noexcept;                                                           \
  template void Fences<S>::validate(const ProxyTable<S>&, const HeldPairs&) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
