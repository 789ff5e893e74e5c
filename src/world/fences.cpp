// SPDX-License-Identifier: MIT
#include "world/fences.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <stdexcept>

#include <boxstream/detail/float_environment.hpp>

namespace boxstream::detail {

namespace {

// Skins, as parts of the mean extent of the box. The first one is a guess that doubling soon corrects; with the widest
// one (a quarter on each side) two boxes of a size have three and a half times the candidates that they have pairs.
constexpr double first_skin = 1.0 / 64;
constexpr double widest_skin = 1.0 / 4;
constexpr double narrowest_skin = 1.0 / 1024;

// Fences should last between so many updates: less, and raising them costs more than the candidates that wider skins
// give; more, and there are candidates that nobody needs.
constexpr std::uint32_t short_life = 32;
constexpr std::uint32_t long_life = 256;

// Beyond these sizes nothing is computed with the bounds of a box, so that nothing overflows or turns NaN.
constexpr double largest_bound = 1e18;
constexpr double smallest_extent = 1e-18;

// The sample: so many neighbours, which share cache lines, of each so many ranks; looked at in each so many updates,
// because those who gain nothing by fences should not pay for them either.
constexpr std::uint32_t sample_interval = 4;
constexpr std::uint32_t sample_run = 8;
constexpr std::uint32_t sample_stride(std::size_t ranks) {
  return ranks < 16384 ? 128 : 512;
}

/// Anywhere in the stride, whatever the pattern in which proxies were created.
constexpr std::uint32_t sample_start(std::uint32_t stride_start, std::uint32_t stride) {
  return stride_start + ((stride_start / stride * 0x9e3779b1u) >> 16) % (stride / sample_run) * sample_run;
}

/// For valid boxes.
template <class S>
bool contains(const BasicAabb<S>& outer, const BasicAabb<S>& inner) {
  bool inside = true;
  for (int d = 0; d < 3; ++d) inside = inside & (outer.min[d] <= inner.min[d]) & (inner.max[d] <= outer.max[d]);
  return inside;
}

template <class S>
S mean_extent(const BasicAabb<S>& box) {
  constexpr S limit = static_cast<S>(largest_bound);
  S sum = 0;
  for (int d = 0; d < 3; ++d) {
    if (!(-limit < box.min[d] && box.max[d] < limit)) return 0;
    sum += box.max[d] - box.min[d];
  }
  return sum < static_cast<S>(smallest_extent) ? 0 : sum / 3;
}

}  // namespace

template <class S>
void Fences<S>::notice(const ProxyTable<S>& proxies) {
  const std::vector<std::uint32_t>& touched = proxies.touched();
  // Where few move, there are cheaper ways to search, and no need to know.
  if (!stand_ && 8 * touched.size() <= proxies.ranks()) return;
  const DefaultFloatEnvironment environment;
  ++update_;
  if (!stand_ && update_ % sample_interval != 0) return;
  grow_to(proxies.ranks());
  std::size_t watched = 0, left = 0;
  if (stand_) {
    watched = proxies.ranks();
    for (const std::uint32_t rank : touched) {
      const Box& box = proxies.box(rank);
      const bool refiltered = (proxies.flags(rank) & ProxyTable<S>::refiltered) != 0;
      const bool valid = proxies.is_valid(rank);
      must_purge_ = must_purge_ || !valid || refiltered;
      if (has_escaped_[rank]) continue;
      if (valid && !refiltered && contains(fences_[rank], box)) continue;
      left += valid && !refiltered && raised_[rank] != 0;
      escape(rank);
    }
  } else {
    const std::size_t ranks = proxies.ranks();
    const std::uint32_t stride = sample_stride(ranks);
    for (std::size_t start = 0; start < ranks; start += stride) {
      const std::uint32_t first = sample_start(static_cast<std::uint32_t>(start), stride);
      const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(ranks, std::size_t{first} + sample_run));
      for (std::uint32_t rank = first; rank < end; ++rank) {
        if (!proxies.is_valid(rank)) continue;
        ++watched;
        if (!proxies.is_touched(rank)) continue;
        const Box& box = proxies.box(rank);
        if (raised_[rank] != 0 && contains(fences_[rank], box)) continue;
        left += raised_[rank] != 0;
        raise(rank, box);
      }
    }
  }
  if (watched == 0) return;
  const double rate = static_cast<double>(left) / static_cast<double>(watched) / (stand_ ? 1 : sample_interval);
  escape_rate_ += (rate - escape_rate_) * (stand_ ? 0.25 : 0.5);
}

template <class S>
void Fences<S>::grow_to(std::size_t ranks) {
  if (is_indexed_) index_.reserve_slots(ranks);
  skins_.resize(ranks, 0);
  raised_.resize(ranks, 0);
  has_escaped_.resize(ranks, false);
  if (fences_.size() < ranks) reserve_more(fences_, ranks - fences_.size());
  escaped_.reserve(fences_.capacity());
  fences_.resize(ranks, ProxyTable<S>::inert_box());  // the last one, because the others go by its size
}

template <class S>
void Fences<S>::escape(std::uint32_t rank) {
  has_escaped_[rank] = true;
  escaped_.push_back(rank);
}

/// `box` may be invalid; then its fence is as well.
template <class S>
void Fences<S>::raise(std::uint32_t rank, const Box& box) {
  fences_[rank] = box;
  if (is_indexed_) index_.mark(rank);
  const std::uint32_t life = update_ - raised_[rank];
  const bool first = raised_[rank] == 0;
  raised_[rank] = update_;
  if (!has_valid_keys(box)) {
    fences_[rank] = ProxyTable<S>::inert_box();
    return;
  }
  const S extent = mean_extent(box);
  S skin = first ? extent * static_cast<S>(first_skin) : skins_[rank];
  if (!first && life < short_life) skin *= 2;
  if (!first && life > long_life) skin /= 2;
  skin = std::clamp(skin, extent * static_cast<S>(narrowest_skin), extent * static_cast<S>(widest_skin));
  skins_[rank] = skin;
  if (skin > 0) fences_[rank] = merged(box, expanded(box, skin));
}

template <class S>
std::size_t Fences<S>::price(const ProxyTable<S>& proxies, std::size_t pairs) const {
  if (!stand_) return lasting_price(proxies, pairs);
  return price(proxies, candidates_.size() + recent_.size(), static_cast<double>(escaped_.size()));
}

template <class S>
std::size_t Fences<S>::lasting_price(const ProxyTable<S>& proxies, std::size_t pairs) const {
  const std::size_t candidates = stand_ ? candidates_.size() + recent_.size() : pairs + pairs / 4;
  return price(proxies, candidates, escape_rate_ * static_cast<double>(proxies.ranks()));
}

/// In the units of OverlapSearch::choose: looking at a moved box or at a candidate costs an eighth. A proxy that has
/// escaped, with the index kept fit and its candidates found, compared and merged, costs 0.7, 1 and 2 microseconds at
/// 10^3, 10^4 and 10^5 boxes.
template <class S>
std::size_t Fences<S>::price(const ProxyTable<S>& proxies, std::size_t candidates, double escaped) const {
  const std::size_t ranks = proxies.ranks();
  const std::size_t walk = (proxies.touched().size() + candidates) / 8;
  const std::size_t renewal = 2 * ranks + candidates;
  const std::size_t escape = 3 * static_cast<std::size_t>(std::bit_width(ranks));
  return walk + std::min(renewal, escape * static_cast<std::size_t>(escaped));
}

/// Those that must be. As long as there are no candidates, the sample's fences and skins are good already.
template <class S>
void Fences<S>::raise_all(const ProxyTable<S>& proxies) {
  const DefaultFloatEnvironment environment;
  if (stand_) {
    for (const std::uint32_t rank : escaped_) raise(rank, proxies.box(rank));
    return;
  }
  for (std::uint32_t rank = 0; rank < proxies.ranks(); ++rank) {
    const Box& box = proxies.box(rank);
    if (raised_[rank] == 0 || !proxies.is_valid(rank) || !contains(fences_[rank], box)) raise(rank, box);
  }
}

template <class S>
void Fences<S>::drop() noexcept {
  stand_ = false;
  index_.clear();
  is_indexed_ = false;
  candidates_.clear();
  recent_.clear();
  changed_.clear();
  for (const std::uint32_t rank : escaped_) has_escaped_[rank] = false;
  escaped_.clear();
  escaped_since_purge_ = 0;
  must_purge_ = false;
}

template <class S>
void Fences<S>::remap(Span<const std::uint32_t> new_rank) noexcept {
  constexpr std::uint32_t none = ProxyTable<S>::none;
  std::size_t count = 0;
  for (std::size_t from = 0; from < fences_.size(); ++from) {
    if (new_rank[from] == none) continue;
    fences_[count] = fences_[from];
    skins_[count] = skins_[from];
    raised_[count] = raised_[from];
    has_escaped_[count] = has_escaped_[from];
    ++count;
  }
  fences_.resize(count);
  skins_.resize(count);
  raised_.resize(count);
  has_escaped_.resize(count);
  std::size_t kept = 0;
  for (const std::uint32_t rank : escaped_)
    if (new_rank[rank] != none) escaped_[kept++] = new_rank[rank];
  escaped_.resize(kept);
  for (auto* list : {&candidates_, &recent_}) {
    kept = 0;
    for (const Candidate candidate : *list) {
      const std::uint32_t a = new_rank[first_of(key_of(candidate))], b = new_rank[second_of(key_of(candidate))];
      if (a != none && b != none) (*list)[kept++] = pair_key(a, b) << 1 | (candidate & 1);
    }
    list->resize(kept);
  }
  kept = 0;
  for (const PairKey key : changed_) {
    const std::uint32_t a = new_rank[first_of(key)], b = new_rank[second_of(key)];
    if (a != none && b != none) changed_[kept++] = pair_key(a, b);
  }
  changed_.resize(kept);
  rows_.clear();
  index_.clear();
  is_indexed_ = false;
}

template <class S>
void Fences<S>::clear() noexcept {
  drop();
  fences_.clear();
  skins_.clear();
  raised_.clear();
  has_escaped_.clear();
  rows_.clear();
  update_ = 0;
  escape_rate_ = 1;
}

template <class S>
void Fences<S>::validate(const ProxyTable<S>& proxies, const HeldPairs& held) const {
  if (!stand_) return;
  const DefaultFloatEnvironment environment;
  const auto check = [](bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
  };
  const auto has_changed = [&](PairKey key) {
    return std::find(changed_.begin(), changed_.end(), key) != changed_.end();
  };
  const auto find = [&](const std::vector<Candidate>& list, PairKey key) {
    const auto at = std::lower_bound(list.begin(), list.end(), key << 1);
    return at != list.end() && key_of(*at) == key;
  };
  for (const auto* list : {&candidates_, &recent_}) {
    check(std::adjacent_find(list->begin(), list->end(), std::greater_equal<>()) == list->end(),
          "fences: candidates are not strictly sorted");
    for (const Candidate candidate : *list)
      check(is_held(candidate) == held.contains(key_of(candidate)) || has_changed(key_of(candidate)),
            "fences: a candidate is wrong about being held");
  }
  for (const Candidate candidate : recent_)
    check(!find(candidates_, key_of(candidate)), "fences: a candidate is there twice");
  held.for_each([&](PairKey key) {
    check(find(candidates_, key) || find(recent_, key) || has_changed(key), "fences: a held pair is no candidate");
    return true;
  });
  for (std::uint32_t rank = 0; rank < fences_.size(); ++rank)
    check(has_escaped_[rank] || proxies.is_touched(rank) || !proxies.is_valid(rank) ||
              contains(fences_[rank], proxies.box(rank)),
          "fences: a box has left its fence unnoticed");
}

// Members are instantiated one by one, because their definitions are spread over two files.
#define INSTANTIATE(S)                                                                    \
  template void Fences<S>::notice(const ProxyTable<S>&);                                  \
  template void Fences<S>::grow_to(std::size_t);                                          \
  template void Fences<S>::raise(std::uint32_t, const Box&);                              \
  template void Fences<S>::raise_all(const ProxyTable<S>&);                               \
  template std::size_t Fences<S>::price(const ProxyTable<S>&, std::size_t) const;         \
  template std::size_t Fences<S>::lasting_price(const ProxyTable<S>&, std::size_t) const; \
  template void Fences<S>::drop() noexcept;                                               \
  template void Fences<S>::remap(Span<const std::uint32_t>) noexcept;                     \
  template void Fences<S>::clear() noexcept;                                              \
  template void Fences<S>::validate(const ProxyTable<S>&, const HeldPairs&) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
