// SPDX-License-Identifier: MIT
//
// The blocks of a sweep as vectors of one SIMD target, and what is done with them.

#if defined(BOXSTREAM_SWEEP_LANES_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_SWEEP_LANES_INL_HPP_
#undef BOXSTREAM_SWEEP_LANES_INL_HPP_
#else
#define BOXSTREAM_SWEEP_LANES_INL_HPP_
#endif

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <hwy/highway.h>

#include <boxstream/pair.hpp>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Boxes of a block, which are compared with one other box at a time. The same on every target, for it shows in the
// order of pairs; a narrower vector makes a block of several.
constexpr std::size_t block = 16;
using D = hn::CappedTag<std::int32_t, block>;
using DU = hn::CappedTag<std::uint32_t, block>;
constexpr std::size_t lanes = hn::MaxLanes(D());
constexpr std::size_t vectors = block / lanes;
using V = hn::VFromD<D>;
using VU = hn::VFromD<DU>;
using M = decltype(hn::Gt(V(), V()));
using MU = decltype(hn::Eq(VU(), VU()));

/// High ends and complements of low ends.
HWY_INLINE VU opposite(VU packed) {
  const DU d;
  const auto swapped = hn::Or(hn::And(hn::ShiftRight<8>(packed), hn::Set(d, 0x00ff00ffu)),
                              hn::And(hn::ShiftLeft<8>(packed), hn::Set(d, 0xff00ff00u)));
  return hn::Not(swapped);
}

/// Lanes in which no byte of `x` is above that of `opposite_y`.
HWY_INLINE MU may_overlap(VU x, VU opposite_y) {
  const DU d;
#if HWY_TARGET == HWY_SCALAR
  // Bytes apart, each below a guard bit that a difference below zero borrows.
  const auto spread = [](std::uint64_t bytes) {
    bytes = (bytes | bytes << 16) & 0x0000ffff0000ffffu;
    return (bytes | bytes << 8) & 0x00ff00ff00ff00ffu;
  };
  constexpr std::uint64_t guards = 0x0100010001000100u;
  const std::uint64_t left = (spread(hn::GetLane(opposite_y)) | guards) - spread(hn::GetLane(x));
  return hn::Eq(hn::Set(d, (left & guards) == guards ? 1u : 0u), hn::Set(d, 1u));
#else
  const hn::Repartition<std::uint8_t, DU> d8;
  return hn::Eq(hn::BitCast(d, hn::SaturatedSub(hn::BitCast(d8, x), hn::BitCast(d8, opposite_y))), hn::Zero(d));
#endif
}

/// Bit i: lane i of at most 16.
template <class DT, class Mask>
HWY_INLINE std::uint32_t bits_of(DT d, Mask mask) {
  if constexpr (hn::MaxLanes(DT()) > 8) {
    std::uint16_t bits;
    hn::StoreMaskBits(d, mask, reinterpret_cast<std::uint8_t*>(&bits));
    return bits;
  } else {
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, mask, bits);
    return bits[0];
  }
}

#if HWY_TARGET == HWY_AVX2

/// Of each byte, the numbers of its bits that are set, and then zeros.
struct SetBits {
  alignas(8) std::uint8_t of[256][8] = {};

  constexpr SetBits() {
    for (unsigned byte = 0; byte < 256; ++byte) {
      std::size_t count = 0;
      for (unsigned bit = 0; bit < 8; ++bit)
        if ((byte >> bit & 1) != 0) of[byte][count++] = static_cast<std::uint8_t>(bit);
    }
  }
};
inline constexpr SetBits set_bits;

/// The lanes in `mask`, one after the other. What is behind them may be anything. Highway's table for this is a local
/// array, a KiB that GCC copies to the stack each time.
template <class DT, class Mask>
HWY_INLINE hn::VFromD<DT> compressed(DT d, hn::VFromD<DT> values, Mask mask) {
  static_assert(sizeof(hn::TFromD<DT>) == 4 && hn::MaxLanes(DT()) <= 8);
  const auto lanes_of_mask = hn::LoadU(hn::Rebind<std::uint8_t, DT>(), set_bits.of[bits_of(d, mask)]);
  return hn::TableLookupLanes(values, hn::IndicesFromVec(d, hn::PromoteTo(d, lanes_of_mask)));
}

#else

template <class DT, class Mask>
HWY_INLINE hn::VFromD<DT> compressed(DT, hn::VFromD<DT> values, Mask mask) {
  return hn::Compress(values, mask);
}

#endif

/// Stores the pairs of the first `count` lanes; room for all of them is needed.
HWY_INLINE void store(VU a, VU b, std::size_t count, Pair* out) {
#if HWY_TARGET == HWY_SCALAR
  (void)count;
  *out = {hn::GetLane(a), hn::GetLane(b)};
#else
  // By way of 64-bit lanes, which takes fewer shuffles than to interleave.
  const hn::Half<DU> dh;
  const hn::RepartitionToWide<DU> d64;
  const auto join = [](auto first, auto second) HWY_ATTR {
    if constexpr (std::endian::native == std::endian::big) std::swap(first, second);
    return hn::Or(first, hn::ShiftLeft<32>(second));
  };
  auto* words = reinterpret_cast<std::uint64_t*>(out);
  hn::StoreU(join(hn::PromoteTo(d64, hn::LowerHalf(dh, a)), hn::PromoteTo(d64, hn::LowerHalf(dh, b))), d64, words);
  if (HWY_LIKELY(count <= lanes / 2)) return;
  hn::StoreU(join(hn::PromoteTo(d64, hn::UpperHalf(dh, a)), hn::PromoteTo(d64, hn::UpperHalf(dh, b))), d64,
             words + lanes / 2);
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
