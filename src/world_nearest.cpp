// SPDX-License-Identifier: MIT
// Boxes and pairs by increasing distance, in bands: all candidates from a floor to a cut are collected, sorted and
// visited, then those from that cut on. A band holds few at first, because the first visits mostly bring the limit
// down, and many later, so that there are few bands. Nothing depends on what was skipped before, so the limit may rise
// as well as fall.
#include <algorithm>

#include "world_core.hpp"
#include "world_nearest_walk.hpp"
#include "world_search.hpp"

namespace boxstream::detail {

namespace {

/// How many candidates the next band may hold and where its cut should start, so that it is about filled.
template <class S>
class NearPlan {
 public:
  explicit NearPlan(std::size_t proxies) : most_(std::clamp(room_per_proxy * proxies, first_room, most_room)) {}

  std::size_t room() const { return room_; }
  bool has_most_room() const { return room_ == most_; }

  S cut(S floor, S limit) const {
    const S cut = floor + width_;
    return floor < cut && cut < limit ? cut : limit;
  }

  /// A band from `floor` to `cut` held so many. If these were few there is no telling how many come next.
  void learn(S floor, S cut, std::size_t count) {
    const bool filled = count >= room_ / 8;
    grow();
    constexpr S inf = std::numeric_limits<S>::infinity();
    width_ = filled ? (cut - floor) * (S(0.75) * static_cast<S>(room_) / static_cast<S>(count)) : inf;
  }
  void grow() { room_ = std::min(room_growth * room_, most_); }

 private:
  static constexpr std::size_t first_room = 64;
  static constexpr std::size_t room_growth = 4;
  static constexpr std::size_t room_per_proxy = 64;
  static constexpr std::size_t most_room = std::size_t{1} << 20;

  std::size_t most_;
  std::size_t room_ = first_room;
  S width_ = std::numeric_limits<S>::infinity();
};

/// The candidates at one distance, of which there may be any number.
template <class S>
class NearExactly {
 public:
  explicit NearExactly(S distance) : distance_(distance), window_(distance, next_above(distance)) {}
  S distance() const { return distance_; }
  const NearWindow<S>& window() const { return window_; }
  static constexpr bool is_tied() { return false; }

 private:
  S distance_;
  NearWindow<S> window_;
};

}  // namespace

template <class S>
void WorldCore<S>::query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const {
  if (!has_valid_keys(box) || !(limit > 0)) return;
  const Bvh<S>& bvh = index_.fresh(proxies_);
  const auto collect = [&](auto& band) {
    const auto offer = [&](std::size_t place, const Box& other) {
      const S distance = distance_below(box, other);
      if (band.wants(distance)) band.add({distance, proxies_.rank_of_slot(bvh.slot_at(place)), 0});
    };
    walk_near_newcomers(bvh, box, band, offer);
    walk_near(bvh, box, band, offer);
  };
  const auto visit_all = [&](Span<const NearCandidate<S>> sorted) {
    for (const NearCandidate<S>& near : sorted) {
      if (!(near.distance < limit)) return false;
      limit = visit(proxies_.id(near.a), near.distance);
    }
    return true;
  };

  S floor = 0;
  {
    NearFew<S, 4> few(floor, limit);
    collect(few);
    if (!visit_all(few.sorted())) return;
    floor = few.cut();
  }
  if (!(floor < limit)) return;
  const typename NearScratchPool<S>::Loan loan(near_scratch_);
  NearBand<S>& band = (*loan).band;
  for (NearPlan<S> plan(proxies_.live()); floor < limit;) {
    band.start(floor, plan.cut(floor, limit), plan.room());
    collect(band);
    if (band.is_tied()) {
      plan.grow();
      continue;
    }
    const Span<const NearCandidate<S>> sorted = band.sorted();
    if (!visit_all(sorted)) return;
    plan.learn(floor, band.cut(), sorted.size());
    floor = band.cut();
  }
}

namespace {

/// One query for pairs of `x` and `y`, which may be the same.
template <class S>
class NearPairs {
 public:
  NearPairs(const ProxyTable<S>& x, const ProxyTable<S>& y, const Bvh<S>& bvh_x, const Bvh<S>& bvh_y,
            NearScratch<S>& scratch)
      : x_(x), y_(y), bvh_x_(bvh_x), bvh_y_(bvh_y), is_same_(&x == &y), scratch_(scratch) {}

  void visit_below(S limit, NearPairVisitor<S> visit) {
    limit_ = limit;
    if (!visit_first_touching(visit)) return;
    S floor = 0;
    {
      NearFew<S, 8> few(floor, limit);
      collect(few);
      if (!visit_band(few.is_tied(), few.sorted(), few.cut(), floor, visit)) return;
    }
    NearBand<S>& band = scratch_.band;
    for (NearPlan<S> plan(is_same_ ? x_.live() : x_.live() + y_.live()); floor < limit_;) {
      band.start(floor, plan.cut(floor, limit_), plan.room());
      collect(band);
      if (band.is_tied() && floor > 0 && !plan.has_most_room()) {
        plan.grow();
        continue;
      }
      const S from = floor;
      const Span<const NearCandidate<S>> sorted = band.sorted();
      if (!visit_band(band.is_tied(), sorted, band.cut(), floor, visit)) return;
      plan.learn(from, floor, sorted.size());
    }
  }

 private:
  template <class Band>
  void collect(Band& band) {
    const auto offer = [&](std::size_t place_x, std::size_t place_y) {
      const BoxBlock<S>& block_x = bvh_x_.block(0, place_x / BoxBlock<S>::width);
      const BoxBlock<S>& block_y = bvh_y_.block(0, place_y / BoxBlock<S>::width);
      const S distance =
          distance_below(block_x.get(place_x % BoxBlock<S>::width), block_y.get(place_y % BoxBlock<S>::width));
      if (!band.wants(distance)) return;
      std::uint32_t a = x_.rank_of_slot(bvh_x_.slot_at(place_x));
      std::uint32_t b = y_.rank_of_slot(bvh_y_.slot_at(place_y));
      if (!accepts(x_.filter(a), y_.filter(b))) return;
      if (is_same_ && b < a) std::swap(a, b);
      if (distance > 0 || a >= touching_rows_) band.add({distance, a, b});
    };
    NearPairWalk<S, Band, decltype(offer)>(bvh_x_, bvh_y_, band, scratch_.steps, offer).run();
  }

  /// Pairs that touch come first anyway, in the order in which rows give them. Where there are many, rows are the
  /// quicker way to the first ones, which may end the query; where there are none, a few rows cost next to nothing.
  bool visit_first_touching(NearPairVisitor<S> visit) {
    constexpr std::uint32_t probes = 8;
    const NearExactly<S> touching(0);
    std::size_t found = 0;
    for (; touching_rows_ < x_.ranks() && (touching_rows_ < probes || 4 * found >= touching_rows_); ++touching_rows_)
      if (!visit_row(touching_rows_, touching, found, visit)) return false;
    return true;
  }

  /// False to stop; else the floor is brought up to where the next band starts.
  bool visit_band(bool is_tied, Span<const NearCandidate<S>> sorted, S cut, S& floor, NearPairVisitor<S> visit) {
    if (is_tied) {
      if (!visit_rows(floor, visit)) return false;
      floor = next_above(floor);
      return true;
    }
    for (const NearCandidate<S>& near : sorted)
      if (!tell(near.a, near.b, near.distance, visit)) return false;
    floor = cut;
    return true;
  }

  /// All pairs at one distance: those of each proxy in turn.
  bool visit_rows(S distance, NearPairVisitor<S> visit) {
    const NearExactly<S> exactly(distance);
    std::size_t found = 0;
    for (std::uint32_t a = distance > 0 ? 0 : touching_rows_; a < x_.ranks(); ++a)
      if (!visit_row(a, exactly, found, visit)) return false;
    return true;
  }

  bool visit_row(std::uint32_t a, const NearExactly<S>& exactly, std::size_t& found, NearPairVisitor<S> visit) {
    if (!x_.is_valid(a)) return true;
    std::vector<std::uint32_t>& row = scratch_.row;
    row.clear();
    const BasicAabb<S>& box = x_.box(a);
    const auto offer = [&](std::size_t place, const BasicAabb<S>& other) {
      const std::uint32_t b = y_.rank_of_slot(bvh_y_.slot_at(place));
      if ((!is_same_ || a < b) && accepts(x_.filter(a), y_.filter(b)) &&
          distance_below(box, other) == exactly.distance())
        row.push_back(b);
    };
    walk_near_newcomers(bvh_y_, box, exactly, offer);
    walk_near(bvh_y_, box, exactly, offer);
    std::sort(row.begin(), row.end());
    for (const std::uint32_t b : row)
      if (!tell(a, b, exactly.distance(), visit)) return false;
    found += row.size();
    return true;
  }

  bool tell(std::uint32_t a, std::uint32_t b, S distance, NearPairVisitor<S> visit) {
    if (!(distance < limit_)) return false;
    limit_ = visit({x_.id(a), y_.id(b)}, distance);
    return true;
  }

  const ProxyTable<S>& x_;
  const ProxyTable<S>& y_;
  const Bvh<S>& bvh_x_;
  const Bvh<S>& bvh_y_;
  const bool is_same_;
  NearScratch<S>& scratch_;
  S limit_ = 0;
  std::uint32_t touching_rows_ = 0;  // whose pairs that touch have been visited
};

}  // namespace

template <class S>
void WorldCore<S>::nearest_pairs(const WorldCore& other, S limit, NearPairVisitor<S> visit) const {
  if (!(limit > 0)) return;
  const Bvh<S>& bvh = index_.fresh(proxies_);
  const Bvh<S>& other_bvh = other.index_.fresh(other.proxies_);
  const typename NearScratchPool<S>::Loan loan(near_scratch_);
  NearPairs<S>(proxies_, other.proxies_, bvh, other_bvh, *loan).visit_below(limit, visit);
}

#define INSTANTIATE(S)                                                                \
  template void WorldCore<S>::query_nearest_box(const Box&, S, NearVisitor<S>) const; \
  template void WorldCore<S>::nearest_pairs(const WorldCore&, S, NearPairVisitor<S>) const
INSTANTIATE(float);
INSTANTIATE(double);
#undef INSTANTIATE

}  // namespace boxstream::detail
