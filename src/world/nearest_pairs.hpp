// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <boxstream/world.hpp>

#include "world/nearest_plan.hpp"
#include "world/nearest_walk.hpp"
#include "world/proxies.hpp"

namespace boxstream::detail {

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
    const auto tell_one = [&](const NearCandidate<S>& near) { return tell(near, visit); };
    S floor = 0;
    {
      // Another look at all pairs of two trees is dear.
      NearFew<S, 12> few(limit, bvh_x_.levels() == 0 || bvh_y_.levels() == 0 ? 4 : 12);
      collect(few, [&](std::size_t place_x, std::size_t place_y, S squared) {
        Names names;
        if (few.wants(squared) && find_names(place_x, place_y, names)) few.add({squared, names.a, names.b});
      });
      const auto resolve = [&](const auto& entry) {
        return NearCandidate<S>{distance_below(x_.box(entry.a), y_.box(entry.b)), entry.a, entry.b};
      };
      if (!few.visit_in_order(resolve, tell_one)) return;
      floor = few.cut();
    }
    NearBand<S>& band = scratch_.band;
    NearPlan<S> plan(is_same_ ? x_.live() : x_.live() + y_.live());
    if (floor == 0 && !visit_more_touching(visit)) return;
    while (floor < limit_) {
      band.start(floor, plan.cut(floor, limit_), plan.room(), plan.room_at_floor());
      collect(band, [&](std::size_t place_x, std::size_t place_y, S) {
        const S distance = distance_below(box_at(bvh_x_, place_x), box_at(bvh_y_, place_y));
        Names names;
        if (band.wants(distance) && find_names(place_x, place_y, names)) band.add({distance, names.a, names.b});
      });
      if (band.is_tied()) {
        if (!visit_rows(floor, visit)) return;
        floor = next_above(floor);
        continue;
      }
      if (!band.visit_in_order(tell_one)) return;
      plan.learn(floor, band.cut(), band.size());
      floor = band.cut();
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

  /// Some more rows, when it is known that there are more than a few such pairs: they may end the query.
  bool visit_more_touching(NearPairVisitor<S> visit) {
    constexpr std::uint32_t most_rows = 1024;
    const NearExactly<S> touching(0);
    std::size_t found = 0;
    const std::uint32_t end =
        touching_rows_ + std::min(most_rows, static_cast<std::uint32_t>(x_.ranks() - touching_rows_) / 16);
    for (; touching_rows_ < end; ++touching_rows_)
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

}  // namespace boxstream::detail
