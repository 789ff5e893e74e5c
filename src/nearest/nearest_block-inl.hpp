// SPDX-License-Identifier: MIT
//
// How far the boxes of a block are from a box.

#if defined(BOXSTREAM_NEAREST_BLOCK_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_NEAREST_BLOCK_INL_HPP_
#undef BOXSTREAM_NEAREST_BLOCK_INL_HPP_
#else
#define BOXSTREAM_NEAREST_BLOCK_INL_HPP_
#endif

#include "bvh/bvh_block.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The larger one; `y` if there is a NaN, which comes from infinities that cancel. That is what maximum means to x86.
template <class V>
HWY_ATTR HWY_INLINE V larger(V x, V y) {
#if HWY_ARCH_X86 && HWY_TARGET != HWY_EMU128 && HWY_TARGET != HWY_SCALAR
  return hn::Max(x, y);
#else
  return hn::IfThenElse(hn::Gt(x, y), x, y);
#endif
}

/// Of lanes from `first` on, with the box given by six numbers. For empty lanes it is some number.
template <class D, class S>
HWY_ATTR HWY_INLINE hn::Vec<D> squared_distances(D d, const BoxBlock<S>& HWY_RESTRICT block, std::size_t first,
                                                 const S (&lo)[3], const S (&hi)[3]) {
  const auto zero = hn::Zero(d);
  auto sum = zero;
  for (int k = 0; k < 3; ++k) {
    const auto below = hn::Sub(hn::Set(d, lo[k]), hn::Load(d, block.hi[k] + first));
    const auto above = hn::Sub(hn::Load(d, block.lo[k] + first), hn::Set(d, hi[k]));
    const auto gap = larger(below, larger(above, zero));
    sum = hn::Add(sum, hn::Mul(gap, gap));
  }
  return sum;
}

/// Of lanes from `first` on, those that hold a box.
template <class D, class S>
HWY_ATTR HWY_INLINE hn::Mask<D> filled_lanes(D d, const BoxBlock<S>& HWY_RESTRICT block, std::size_t first) {
  return hn::Le(hn::Load(d, block.lo[0] + first), hn::Load(d, block.hi[0] + first));
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif  // once per SIMD target
