// SPDX-License-Identifier: MIT
#include "verdict_table.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

namespace {

using LaneBits = std::conditional_t<sizeof(btScalar) == 4, std::uint32_t, std::uint64_t>;

/// A bit for each lane. A plain array, for compilers make vectors of no other.
constexpr struct BitOfLane {
  constexpr BitOfLane() {
    for (std::size_t i = 0; i < 32; ++i) bits[i] = LaneBits{1} << i;
  }
  LaneBits bits[32] = {};
} of_lane;

}  // namespace

/// In a form of which compilers make vectors.
template <std::uint32_t most_proxies>
typename VerdictTable<most_proxies>::Set VerdictTable<most_proxies>::touching(const KeyBox& box,
                                                                              std::uint32_t size) const {
  const Key min_x = box.lo[0], min_y = box.lo[1], min_z = box.lo[2];
  const Key max_x = box.hi[0], max_y = box.hi[1], max_z = box.hi[2];
  Set set;
  for (std::uint32_t first = 0; first < size; first += Set::word) {
    const Key *const lo_x = lo_[0] + first, *const lo_y = lo_[1] + first, *const lo_z = lo_[2] + first;
    const Key *const hi_x = hi_[0] + first, *const hi_y = hi_[1] + first, *const hi_z = hi_[2] + first;
    constexpr std::uint32_t vector = 4;  // fewer go one by one: to load a vector of numbers just stored takes longer
    const std::uint32_t count = std::min(size - first, Set::word);
    const std::uint32_t lanes = size < vector ? count : (count + 7) / 8 * 8;
    LaneBits touching = 0;
    for (std::uint32_t i = 0; i < lanes; ++i) {
      const bool apart = (lo_x[i] > max_x) | (min_x > hi_x[i]) | (lo_y[i] > max_y) | (min_y > hi_y[i]) |
                         (lo_z[i] > max_z) | (min_z > hi_z[i]);
      touching |= apart ? 0 : of_lane.bits[i];
    }
    set.words[first / Set::word] = std::uint32_t(touching) & ~std::uint32_t{0} >> (Set::word - count);
  }
  return set;
}

// As <boxstream/bullet.hpp> says.
static_assert(sizeof(VerdictTable<128>) < (sizeof(btScalar) == 4 ? 9500 : 13000));
static_assert(sizeof(VerdictTable<320>) < (sizeof(btScalar) == 4 ? 46500 : 54000));

template class VerdictTable<32>;
template class VerdictTable<128>;
template class VerdictTable<320>;

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
