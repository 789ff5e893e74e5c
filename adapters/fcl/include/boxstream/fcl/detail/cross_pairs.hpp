// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <boxstream/detector.hpp>
#include <boxstream/fcl/detail/box_set.hpp>

namespace boxstream::fcl::detail {

/// Pairs of places as they come, to be read in order: by row (the place in the first set), then by column.
class CrossPairs {
 public:
  explicit CrossPairs(std::size_t most) : most_(most) { found_.reserve(512); }

  /// False once there are more than are to be held.
  bool add(Place row, Place column) {
    if (found_.size() == most_) return false;
    found_.push_back({row, column});
    return true;
  }

  /// Stable, in a few passes for any number of pairs: comparing them one by one would take longer than finding them.
  /// Places are below `end`.
  void sort_by_column(Place end) { sort_by(&Pair::b, end); }
  void sort_by_row(Place end) { sort_by(&Pair::a, end); }

  /// Until `visit(row, column)` returns false.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const Pair pair : found_)
      if (!visit(pair.a, pair.b)) return;
  }

 private:
  void sort_by(Place Pair::*key, Place end) {
    sorted_.resize(found_.size());
    for (unsigned shift = 0; shift < 32 && (end - 1) >> shift != 0; shift += 8) {
      std::size_t next[257] = {};
      for (const Pair& pair : found_) ++next[(pair.*key >> shift & 0xff) + 1];
      for (int digit = 0; digit < 256; ++digit) next[digit + 1] += next[digit];
      for (const Pair& pair : found_) sorted_[next[pair.*key >> shift & 0xff]++] = pair;
      found_.swap(sorted_);
    }
  }

  std::size_t most_;
  std::vector<Pair> found_;
  std::vector<Pair> sorted_;
};

/// Row by row, with memory for one row. Returns whether `visit` never returned false.
template <class Object, class S, class Visit>
bool for_each_cross_pair_in_rows(const BoxSet<Object, S>& a, Place first, Place last, const BoxSet<Object, S>& b,
                                 Visit&& visit) {
  bool going_on = true;
  for (Place row = first; going_on && row < last; ++row)
    b.for_each_overlap(a.roster().box(row), a.roster().filter(row),
                       [&](Place column) { return going_on = visit(row, column); });
  return going_on;
}

/// Calls `visit(place in a, place in b)` for each pair of a box of `a` and one of `b` that touch, ordered by the first,
/// then the second. Visitors as those of BoxSet.
template <class Object, class S, class Visit>
void for_each_cross_pair(const BoxSet<Object, S>& a, const BoxSet<Object, S>& b, Visit&& visit) {
  const auto& rows = a.roster();
  const auto& columns = b.roster();
  if (rows.size() == 0 || columns.size() == 0) return;
  const bool is_small = std::uint64_t{rows.places()} * columns.places() <= 4096;
  if (is_small || columns.size() / 8 >= rows.size()) {
    for_each_cross_pair_in_rows(a, 0, rows.places(), b, visit);
    return;
  }

  // Two rows cost little and may be all that is asked for.
  const Place first = std::min<Place>(2, rows.places());
  if (!for_each_cross_pair_in_rows(a, 0, first, b, visit)) return;

  CrossPairs found((std::size_t{1} << 20) + 8 * (rows.size() + columns.size()));
  bool are_all = true;
  if (rows.size() / 8 >= columns.size()) {
    for (Place column = 0; are_all && column < columns.places(); ++column)
      a.for_each_overlap_in_any_order(columns.box(column), columns.filter(column),
                                      [&](Place row) { return row < first || (are_all = found.add(row, column)); });
  } else {
    Detector detector;
    const auto keep = [&](Span<const Pair> pairs) {
      for (const Pair p : pairs)
        if (p.a >= first && accepts(rows.filter(p.a), columns.filter(p.b))) are_all = are_all && found.add(p.a, p.b);
      return are_all;
    };
    detector.stream_pairs(Span<const BasicAabb<S>>(rows.boxes()), Span<const BasicAabb<S>>(columns.boxes()), keep);
    found.sort_by_column(columns.places());
  }
  if (!are_all) {
    for_each_cross_pair_in_rows(a, first, rows.places(), b, visit);
    return;
  }
  found.sort_by_row(rows.places());
  found.for_each(visit);
}

}  // namespace boxstream::fcl::detail
