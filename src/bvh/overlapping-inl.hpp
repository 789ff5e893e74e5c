// SPDX-License-Identifier: MIT
//
// What a block and a box have in common.

#if defined(BOXSTREAM_OVERLAPPING_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_OVERLAPPING_INL_HPP_
#undef BOXSTREAM_OVERLAPPING_INL_HPP_
#else
#define BOXSTREAM_OVERLAPPING_INL_HPP_
#endif

#include "bvh/bvh_block.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lanes of `block` that share a point with `box`.
template <class S>
HWY_ATTR HWY_INLINE unsigned overlapping(const BoxBlock<S>& HWY_RESTRICT block, const BasicAabb<S>& box) {
  constexpr std::size_t width = BoxBlock<S>::width;
  const hn::CappedTag<S, width> d;
  unsigned lanes = 0;
  for (std::size_t i = 0; i < width; i += hn::Lanes(d)) {
    const auto least = hn::Load(d, block.lo[0] + i);
    const auto most = hn::Load(d, block.hi[0] + i);
    // An empty lane seems to touch what has no bounds at all.
    auto in = hn::And(hn::Le(least, most),
                      hn::And(hn::Le(least, hn::Set(d, box.max[0])), hn::Le(hn::Set(d, box.min[0]), most)));
    for (int k = 1; k < 3; ++k)
      in = hn::And(in, hn::And(hn::Le(hn::Load(d, block.lo[k] + i), hn::Set(d, box.max[k])),
                               hn::Le(hn::Set(d, box.min[k]), hn::Load(d, block.hi[k] + i))));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, in, bits);
    lanes |= unsigned{bits[0]} << i;
  }
  return lanes;
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif  // once per SIMD target
