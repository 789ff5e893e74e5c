// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <boxstream/aabb.hpp>
#include <boxstream/bullet/precision.hpp>

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// A bit for each of few proxies, by their positions.
template <std::uint32_t most>
struct PositionSet {
  static constexpr std::uint32_t word = 32, count = most / word;
  static_assert(most % word == 0);

  bool has(std::uint32_t position) const { return (words[position / word] >> position % word & 1) != 0; }
  void put(std::uint32_t position) { words[position / word] |= bit(position); }
  void take(std::uint32_t position) { words[position / word] &= ~bit(position); }
  bool is_empty() const {
    std::uint32_t any = 0;
    for (const std::uint32_t some : words) any |= some;
    return any == 0;
  }
  bool has_more_than(std::uint32_t limit) const {
    for (const std::uint32_t some : words)
      for (std::uint32_t left = some; left != 0; left &= left - 1)
        if (limit-- == 0) return true;
    return false;
  }
  /// In ascending order. `visit` may change the set.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::uint32_t w = 0; w < count; ++w)
      for (std::uint32_t left = words[w]; left != 0; left &= left - 1)
        visit(w * word + std::uint32_t(std::countr_zero(left)));
  }

  static std::uint32_t bit(std::uint32_t position) { return std::uint32_t{1} << position % word; }

  std::uint32_t words[count] = {};
};

/// Of up to `most` proxies, by their positions: boxes in columns, which pairs are held, and which of the World.
template <std::uint32_t most_proxies>
class VerdictTable {
 public:
  static constexpr std::uint32_t most = most_proxies;
  using Set = PositionSet<most>;
  using Box = BasicAabb<btScalar>;

  /// Integers that compare as the numbers do, so that no floating-point environment has to be entered.
  using Key = std::conditional_t<sizeof(btScalar) == 4, std::int32_t, std::int64_t>;
  struct KeyBox {
    bool is_valid() const {
      constexpr auto infinity = std::bit_cast<Key>(std::numeric_limits<btScalar>::infinity());
      for (int d = 0; d < 3; ++d)
        if (lo[d] > hi[d] || lo[d] < ~infinity || hi[d] > infinity) return false;
      return true;
    }
    Key lo[3], hi[3];
  };

  /// Holds nothing with others.
  void add(std::uint32_t position) { held_[position] = in_world_[position] = {}; }
  void move(std::uint32_t position, const Box& box) {
    set_box(position, box);
    moved.put(position);
  }
  void set_box(std::uint32_t position, const Box& box) {
    for (int d = 0; d < 3; ++d) {
      lo_[d][position] = key(box.min[d]);
      hi_[d][position] = key(box.max[d]);
    }
  }
  KeyBox box(std::uint32_t position) const {
    return {{lo_[0][position], lo_[1][position], lo_[2][position]},
            {hi_[0][position], hi_[1][position], hi_[2][position]}};
  }
  /// Those that were moved since they were looked at.
  Set moved;

  /// Those of the first `size` that this box touches, which is valid or not. Itself is among them, if it is one.
  Set touching(const KeyBox& box, std::uint32_t size) const;

  const Set& held(std::uint32_t position) const { return held_[position]; }
  const Set& in_world(std::uint32_t position) const { return in_world_[position]; }
  Set untold(std::uint32_t position) const {
    Set set;
    for (std::uint32_t w = 0; w < Set::count; ++w)
      set.words[w] = held_[position].words[w] ^ in_world_[position].words[w];
    return set;
  }
  /// Both, of two.
  void hold(std::uint32_t a, std::uint32_t b) {
    for (auto* rows : {held_, in_world_}) {
      rows[a].put(b);
      rows[b].put(a);
    }
  }
  /// The World is told of all that are held.
  void note_told(std::uint32_t size) { std::copy_n(held_, size, in_world_); }
  /// All pairs of this one have ended, here and in the World.
  void release(std::uint32_t position) {
    for (auto* rows : {held_, in_world_}) {
      rows[position].for_each([&](std::uint32_t other) { rows[other].take(position); });
      rows[position] = {};
    }
  }
  /// One that has none is gone, and the last one takes its position.
  void replace(std::uint32_t gone, std::uint32_t last) {
    if (moved.has(last)) moved.put(gone);
    moved.take(last);
    for (int d = 0; d < 3; ++d) {
      lo_[d][gone] = lo_[d][last];
      hi_[d][gone] = hi_[d][last];
    }
    for (auto* rows : {held_, in_world_}) {
      rows[gone] = rows[last];
      rows[last].for_each([&](std::uint32_t other) {
        rows[other].take(last);
        rows[other].put(gone);
      });
    }
  }

  /// Notes that the pair begins, or that it ends if it is held: both, of two.
  void change(std::uint32_t a, std::uint32_t b) {
    changed_[a].put(b);
    changed_[b].put(a);
    changing_.put(a);
    changing_.put(b);
  }
  bool changes(std::uint32_t a, std::uint32_t b) const { return changed_[a].has(b); }
  /// Begins and ends what was noted. Calls `begins(a, b)`, a below b, in ascending order, and returns whether any ends.
  template <class Begins>
  bool apply(Begins&& begins) {
    bool ends = false;
    changing_.for_each([&](std::uint32_t a) {
      changed_[a].for_each([&](std::uint32_t b) {
        if (held_[a].has(b))
          ends = true;
        else if (b > a)
          begins(a, b);
      });
      for (std::uint32_t w = 0; w < Set::count; ++w) held_[a].words[w] ^= changed_[a].words[w];
    });
    return ends;
  }
  /// Before others are noted.
  void forget_changes() {
    changing_.for_each([&](std::uint32_t a) { changed_[a] = {}; });
    changing_ = {};
  }

 private:
  static Key key(btScalar x) {
    constexpr Key least = std::numeric_limits<Key>::min();
    const Key bits = std::bit_cast<Key>(x);
    return bits == least ? 0 : bits ^ ((bits >> (8 * sizeof(Key) - 1)) & ~least);  // -0 is 0
  }

  Key lo_[3][most] = {}, hi_[3][most] = {};  // those past the last one are any
  Set held_[most], in_world_[most];
  Set changed_[most], changing_;
};

extern template class VerdictTable<32>;
extern template class VerdictTable<128>;
extern template class VerdictTable<320>;

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
