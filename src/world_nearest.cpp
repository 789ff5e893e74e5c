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

constexpr std::size_t first_room = 64;
constexpr std::size_t room_growth = 4;
constexpr std::size_t room_per_proxy = 64;
constexpr std::size_t most_room = std::size_t{1} << 20;

}  // namespace

template <class S>
void WorldCore<S>::query_nearest_box(const Box& box, S limit, NearVisitor<S> visit) const {
  if (!has_valid_keys(box)) return;
  const Bvh<S>& bvh = index_.fresh(proxies_);
  const typename NearScratchPool<S>::Loan loan(near_scratch_);
  NearScratch<S>& scratch = *loan;
  NearBand<S>& band = scratch.band;
  S floor = 0;
  const std::size_t most = std::max(first_room, proxies_.live());
  for (std::size_t room = first_room; floor < limit; room = std::min(room_growth * room, most)) {
    band.start(floor, limit, room);
    const auto window = [&]() -> const NearWindow<S>& { return band.window(); };
    const auto done = [&] { return band.is_tied(); };
    const auto offer = [&](std::size_t place) {
      const std::uint32_t rank = proxies_.rank_of_slot(bvh.slot_at(place));
      const S distance = distance_below(box, proxies_.box(rank));
      if (band.wants(distance)) band.add({distance, rank, 0});
    };
    walk_near_row(bvh, bvh.tree_blocks(), bvh.leaf_blocks(), box, window, done, offer);
    walk_near(bvh, box, scratch.steps, window, done, offer);
    if (band.is_tied()) continue;
    for (const auto& near : band.sorted()) {
      if (!(near.distance < limit)) return;
      limit = visit(proxies_.id(near.a), near.distance);
    }
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
    NearBand<S>& band = scratch_.band;
    const std::size_t most = std::clamp(room_per_proxy * (x_.live() + y_.live()), first_room, most_room);
    std::size_t room = first_room;
    for (S floor = 0; floor < limit_;) {
      band.start(floor, limit_, room);
      collect();
      if (!band.is_tied()) {
        for (const auto& near : band.sorted())
          if (!tell(near.a, near.b, near.distance, visit)) return;
        floor = band.cut();
      } else if (floor == 0 || room == most) {
        if (!visit_rows(floor, visit)) return;
        floor = next_above(floor);
      }
      room = std::min(room_growth * room, most);
    }
  }

 private:
  void collect() {
    NearBand<S>& band = scratch_.band;
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
      band.add({distance, a, b});
    };
    NearPairWalk<S, decltype(offer)>(bvh_x_, bvh_y_, scratch_, offer).run();
  }

  /// All pairs at one distance, of which there may be any number: those of each proxy in turn.
  bool visit_rows(S distance, NearPairVisitor<S> visit) {
    const NearWindow<S> only(distance, next_above(distance));
    const auto window = [&]() -> const NearWindow<S>& { return only; };
    const auto done = [] { return false; };
    std::vector<std::uint32_t>& row = scratch_.row;
    for (std::uint32_t a = 0; a < x_.ranks(); ++a) {
      if (!x_.is_valid(a)) continue;
      row.clear();
      const BasicAabb<S>& box = x_.box(a);
      const auto offer = [&](std::size_t place) {
        const std::uint32_t b = y_.rank_of_slot(bvh_y_.slot_at(place));
        if ((!is_same_ || a < b) && accepts(x_.filter(a), y_.filter(b)) && distance_below(box, y_.box(b)) == distance)
          row.push_back(b);
      };
      walk_near_row(bvh_y_, bvh_y_.tree_blocks(), bvh_y_.leaf_blocks(), box, window, done, offer);
      walk_near(bvh_y_, box, scratch_.steps, window, done, offer);
      std::sort(row.begin(), row.end());
      for (const std::uint32_t b : row)
        if (!tell(a, b, distance, visit)) return false;
    }
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
};

}  // namespace

template <class S>
void WorldCore<S>::nearest_pairs(const WorldCore& other, S limit, NearPairVisitor<S> visit) const {
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
