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

namespace {

template <class S>
BasicAabb<S> box_at(const Bvh<S>& bvh, std::size_t place) {
  return bvh.block(0, place / BoxBlock<S>::width).get(place % BoxBlock<S>::width);
}

}  // namespace

template <class S>
void WorldCore<S>::query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const {
  if (!has_valid_keys(box) || !(limit > 0)) return;
  const Bvh<S>& bvh = index_.fresh(proxies_);
  const auto collect = [&](auto& band, auto&& offer) {
    walk_near_newcomers(bvh, box, band, offer);
    walk_near(bvh, box, band, offer);
  };
  const auto resolve = [&](std::size_t place) {
    return NearCandidate<S>{distance_below(box, box_at(bvh, place)), proxies_.rank_of_slot(bvh.slot_at(place)), 0};
  };
  const auto tell = [&](const NearCandidate<S>& near) {
    if (!(near.distance < limit)) return false;
    limit = visit(proxies_.id(near.a), near.distance);
    return true;
  };

  S floor = 0;
  {
    NearFew<S, 4> few(limit);
    collect(few, [&](std::size_t place, S squared) {
      if (few.wants(squared)) few.add({squared, static_cast<std::uint32_t>(place), 0});
    });
    if (!few.visit_in_order([&](const auto& entry) { return resolve(entry.a); }, tell)) return;
    floor = few.cut();
  }
  if (!(floor < limit)) return;
  const typename NearScratchPool<S>::Loan loan(near_scratch_);
  NearBand<S>& band = (*loan).band;
  for (NearPlan<S> plan(proxies_.live()); floor < limit;) {
    band.start(floor, plan.cut(floor, limit), plan.room());
    collect(band, [&](std::size_t place, S) {
      const NearCandidate<S> candidate = resolve(place);
      if (band.wants(candidate.distance)) band.add(candidate);
    });
    if (band.is_tied()) {
      plan.grow();
      continue;
    }
    const Span<const NearCandidate<S>> sorted = band.sorted();
    for (const NearCandidate<S>& near : sorted)
      if (!tell(near)) return;
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
      NearFew<S, 8> few(limit);
      collect(few, [&](std::size_t place_x, std::size_t place_y, S squared) {
        Names names;
        if (few.wants(squared) && find_names(place_x, place_y, names)) few.add({squared, names.a, names.b});
      });
      const auto resolve = [&](const auto& entry) {
        return NearCandidate<S>{distance_below(x_.box(entry.a), y_.box(entry.b)), entry.a, entry.b};
      };
      if (!few.visit_in_order(resolve, [&](const NearCandidate<S>& near) { return tell(near, visit); })) return;
      floor = few.cut();
    }
    if (floor == 0) {  // more than a few touch
      if (!visit_rows(floor, visit)) return;
      floor = next_above(floor);
    }
    NearBand<S>& band = scratch_.band;
    for (NearPlan<S> plan(is_same_ ? x_.live() : x_.live() + y_.live()); floor < limit_;) {
      band.start(floor, plan.cut(floor, limit_), plan.room());
      collect(band, [&](std::size_t place_x, std::size_t place_y, S) {
        const S distance = distance_below(box_at(bvh_x_, place_x), box_at(bvh_y_, place_y));
        Names names;
        if (band.wants(distance) && find_names(place_x, place_y, names)) band.add({distance, names.a, names.b});
      });
      if (!band.is_tied()) {
        const Span<const NearCandidate<S>> sorted = band.sorted();
        for (const NearCandidate<S>& near : sorted)
          if (!tell(near, visit)) return;
        plan.learn(floor, band.cut(), sorted.size());
        floor = band.cut();
      } else if (floor > 0 && !plan.has_most_room()) {
        plan.grow();
      } else {
        if (!visit_rows(floor, visit)) return;
        floor = next_above(floor);
      }
    }
  }

 private:
  struct Names {
    std::uint32_t a;
    std::uint32_t b;
  };

  /// False if the pair is none, or one of those that touch and have been visited.
  bool find_names(std::size_t place_x, std::size_t place_y, Names& names) const {
    names = {x_.rank_of_slot(bvh_x_.slot_at(place_x)), y_.rank_of_slot(bvh_y_.slot_at(place_y))};
    if (!accepts(x_.filter(names.a), y_.filter(names.b))) return false;
    if (is_same_ && names.b < names.a) std::swap(names.a, names.b);
    return names.a >= touching_rows_ || distance_below(x_.box(names.a), y_.box(names.b)) > 0;
  }

  template <class Band, class Offer>
  void collect(Band& band, Offer&& offer) {
    NearPairWalk<S, Band, Offer&>(bvh_x_, bvh_y_, band, scratch_.steps, offer).run();
  }

  /// Pairs that touch come first anyway, in the order in which rows give them. Where there are many, rows are the
  /// quicker way to the first ones, which may end the query; where there are none, a few rows cost next to nothing.
  bool visit_first_touching(NearPairVisitor<S> visit) {
    constexpr std::uint32_t probes = 4;
    const NearExactly<S> touching(0);
    std::size_t found = 0;
    for (; touching_rows_ < x_.ranks() && (touching_rows_ < probes || 4 * found >= touching_rows_); ++touching_rows_)
      if (!visit_row(touching_rows_, touching, found, visit)) return false;
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
    const auto offer = [&](std::size_t place, S) {
      const std::uint32_t b = y_.rank_of_slot(bvh_y_.slot_at(place));
      if ((!is_same_ || a < b) && accepts(x_.filter(a), y_.filter(b)) &&
          distance_below(box, box_at(bvh_y_, place)) == exactly.distance())
        row.push_back(b);
    };
    walk_near_newcomers(bvh_y_, box, exactly, offer);
    walk_near(bvh_y_, box, exactly, offer);
    std::sort(row.begin(), row.end());
    for (const std::uint32_t b : row)
      if (!tell({exactly.distance(), a, b}, visit)) return false;
    found += row.size();
    return true;
  }

  bool tell(const NearCandidate<S>& near, NearPairVisitor<S> visit) {
    if (!(near.distance < limit_)) return false;
    limit_ = visit({x_.id(near.a), y_.id(near.b)}, near.distance);
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
