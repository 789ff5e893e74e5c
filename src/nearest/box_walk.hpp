// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "bvh/bvh.hpp"

namespace boxstream::detail {

/// The boxes of a block, how far they are from one box, and which are left: a lane and its squared distance, about, in
/// one integer. Numbers that are not negative have the order of their bits, and the lowest bits are replaced by the
/// lane: the nearest lane is that of the least integer, and no branch depends on it.
template <class S>
struct alignas(64) NearLanes {
  using Key = std::conditional_t<sizeof(S) == 4, std::int32_t, std::int64_t>;

  static constexpr unsigned width = BoxBlock<S>::width;
  static constexpr Key lane_bits = width - 1;
  static constexpr Key gone = std::numeric_limits<Key>::max();  // of lanes that are visited, or empty

  /// No key within reach is larger.
  static Key key_of(S reach) { return std::bit_cast<Key>(reach) | lane_bits; }
  static Key key_at(S squared, unsigned lane) {
    return (std::bit_cast<Key>(squared) & ~lane_bits) | static_cast<Key>(lane);
  }
  static unsigned lane_of(Key key) { return static_cast<unsigned>(key & lane_bits); }
  static S squared_of(Key key) { return std::bit_cast<S>(key & ~lane_bits); }

  Key least() const {
    const auto smaller = [](Key a, Key b) { return b < a ? b : a; };
    return smaller(smaller(smaller(keys[0], keys[1]), smaller(keys[2], keys[3])),
                   smaller(smaller(keys[4], keys[5]), smaller(keys[6], keys[7])));
  }

  Key keys[width];
  std::uint32_t block;
  std::uint32_t level;
};

/// A walk over the tree of an index from the block nearest to a box to those further away, as depth first as it goes.
/// It knows what it has yet to visit; the last one open is a leaf.
template <class S>
struct BoxWalk {
  static constexpr unsigned most_levels = Bvh<S>::most_levels;

  unsigned count = 0;
  NearLanes<S> open[most_levels];

  NearLanes<S>& leaf() { return open[count - 1]; }
};

/// Begins at the root of an index that has a tree.
void begin_walk(const Bvh<float>& bvh, const Aabb& box, BoxWalk<float>& walk);
void begin_walk(const Bvh<double>& bvh, const Aabb64& box, BoxWalk<double>& walk);

/// Goes on to the next leaf that has a key of at most `reach`; false at the end. `box` is valid, and always the same.
bool find_next(const Bvh<float>& bvh, const Aabb& box, std::int32_t reach, BoxWalk<float>& walk);
bool find_next(const Bvh<double>& bvh, const Aabb64& box, std::int64_t reach, BoxWalk<double>& walk);

/// Eight leaf blocks at most, and their least keys as those of lanes.
template <class S>
struct BoxRow {
  NearLanes<S> nearest;
  NearLanes<S> blocks[NearLanes<S>::width];
};

void open_row(const BoxBlock<float>* leaves, std::size_t first, std::size_t count, const Aabb& box, BoxRow<float>& row);
void open_row(const BoxBlock<double>* leaves, std::size_t first, std::size_t count, const Aabb64& box,
              BoxRow<double>& row);

}  // namespace boxstream::detail
