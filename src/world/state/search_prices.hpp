// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/thresholds.hpp"

namespace boxstream::detail {

/// What the ways of an update cost, in units of one box in a batch of all, which is 30 to 60 ns. All choices between
/// them go by this list.
namespace prices {

using Price = std::uint64_t;

inline Price all(std::size_t boxes) {
  return boxes;
}

/// Of the dirty boxes in the index, with what it takes to keep it fit for the next time: 60, 90, 120 and 170 ns a box
/// at 10^2, 10^3, 10^4 and 10^5 boxes. It grows as the tree is deep.
inline Price probe(std::size_t boxes, std::size_t dirty) {
  return dirty * static_cast<Price>(std::bit_width(boxes)) / 5;
}

/// Of comparing the dirty boxes with all. Where those are so few that nothing is set up, a comparison takes a quarter
/// of a nanosecond, and each box two to be read. More of them are searched as two sets, of which the larger one is
/// mostly culled.
inline Price beside(std::size_t boxes, std::size_t dirty) {
  const Price as_sets = all(boxes) / 5 + 7 * Price{dirty};
  return dirty > thresholds.few ? as_sets : std::min(as_sets, all(boxes) * (dirty + 8) / 125);
}

/// Of few boxes by rows of bits: all, or those of the dirty ones. A row takes as long as two thirds of a box in a
/// batch, and one more for 70 boxes that it has; one of all rows has half of the boxes, and less to set up.
inline Price rows(std::size_t boxes) {
  return Price{boxes} * (69 + boxes) / 137;
}
inline Price dirty_rows(std::size_t boxes, std::size_t dirty) {
  return Price{dirty} * (47 + boxes) / 70;
}

/// Of looking up the pairs that a probe finds, or a batch of so many boxes: a box takes longer there where they do not
/// fit the nearest caches. With candidates they cost nothing.
inline Price pairs(std::size_t count) {
  return count / 2;
}
inline Price pairs_of_batch(std::size_t boxes, std::size_t count) {
  return count / (boxes < thresholds.in_near_caches ? 2 : 4);
}

/// Of a pass over candidates: a tenth for each moved box and each candidate that is compared; a fourth where the boxes
/// do not fit the nearest caches, and two fifths where they fit none.
inline Price pass(std::size_t dirty, std::uint64_t compared) {
  const Price passed = dirty + compared;
  if (dirty < thresholds.in_near_caches) return passed / 10;
  return dirty < thresholds.in_caches ? passed / 4 : passed * 2 / 5;
}

/// Of fitting all fat boxes anew and finding all candidates.
inline Price rebuild(std::size_t boxes, std::size_t held, std::uint64_t candidates) {
  return all(boxes) + boxes / 4 + pairs(held) + candidates / 4;
}

}  // namespace prices

/// Boxes that have left their fat boxes are looked up one by one, by scans, rather than by an index of fat boxes.
inline bool exits_are_scanned(std::size_t exits, bool is_indexed) {
  return !is_indexed && exits <= thresholds.most_scans;
}

/// Candidates as they are when an update begins, as far as prices depend on them.
struct CandidateState {
  bool are_kept = false;
  std::size_t fat_boxes = 0;
  std::size_t candidates = 0, compared = 0;  ///< all, and those that a pass compares
  std::size_t exits = 0;                     ///< boxes that have left their fat boxes
  bool is_indexed = false;                   ///< there is an index of the fat boxes
};

namespace prices {

/// Of the boxes that have left their fat boxes. A scan of all fat boxes takes a fortieth of a batch for each. By the
/// index, refits included, each takes 0.7, 1 and 2 microseconds at 10^3, 10^4 and 10^5 boxes. One more pass over all
/// candidates comes on top.
inline Price exits(const CandidateState& state) {
  if (state.exits == 0) return 0;
  const Price again = state.candidates / 10;
  if (exits_are_scanned(state.exits, state.is_indexed)) return Price{state.fat_boxes} / 40 * state.exits + again;
  return (state.is_indexed ? 0 : 3 * Price{state.fat_boxes}) +
         3 * static_cast<Price>(std::bit_width(state.fat_boxes)) * state.exits + again;
}

}  // namespace prices
}  // namespace boxstream::detail
