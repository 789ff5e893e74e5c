// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "bytes.hpp"
#include "core/oracle.hpp"

namespace boxstream::fuzz {

template <class S>
struct TwoSets {
  tests::Boxes<S> a, b;
};

/// Boxes to the end of an input, by a code:
///   00-c7  one box (bytes.hpp)
///   c8-e7  the box before, as many times as the next byte says, each moved on along an axis (code % 3) by a number
///   e8-f7  a cloud: 8 boxes times the next byte, drawn on a grid of 1 + code - e8 cells by the seed in the byte after
///   f8-ff  the boxes that follow go to the other set
template <class S>
TwoSets<S> read_sets(Bytes& in, std::size_t most_boxes) {
  TwoSets<S> sets;
  tests::Boxes<S>* set = &sets.a;
  BasicAabb<S> last{};
  const auto has_room = [&] { return sets.a.size() + sets.b.size() < most_boxes; };
  while (!in.empty() && has_room()) {
    const unsigned code = in.byte();
    if (code < 0xc8) {
      set->push_back(last = in.box<S>());
    } else if (code < 0xe8) {
      const unsigned count = in.byte();
      const S step = in.number<S>();
      for (unsigned i = 0; i < count && has_room(); ++i) {
        last.min[code % 3] += step;
        last.max[code % 3] += step;
        set->push_back(last);
      }
    } else if (code < 0xf8) {
      const unsigned count = 8u * in.byte();
      std::minstd_rand random(1u + in.byte());
      for (unsigned i = 0; i < count && has_room(); ++i) set->push_back(drawn_box<S>(random, code - 0xe7));
    } else {
      set = set == &sets.a ? &sets.b : &sets.a;
    }
  }
  return sets;
}

/// Offsets of `count` sets, of which some are empty.
inline std::vector<std::uint64_t> cut(std::size_t boxes, unsigned count) {
  std::minstd_rand random(count);
  std::vector<std::uint64_t> offsets{0, boxes};
  while (offsets.size() <= count) offsets.push_back(random() % (boxes + 1));
  std::sort(offsets.begin(), offsets.end());
  return offsets;
}

/// In which set a box is.
inline std::size_t set_of(std::size_t box, const std::vector<std::uint64_t>& offsets) {
  return static_cast<std::size_t>(std::upper_bound(offsets.begin(), offsets.end(), box) - offsets.begin()) - 1;
}

}  // namespace boxstream::fuzz
