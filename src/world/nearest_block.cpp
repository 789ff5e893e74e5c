// SPDX-License-Identifier: MIT
#include "world/nearest_block.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/nearest_block.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The larger one; `y` if there is a NaN, which comes from infinities that cancel.
template <class V>
HWY_ATTR HWY_INLINE V larger(V x, V y) {
  return hn::IfThenElse(hn::Gt(x, y), x, y);
}

template <bool Leaf, class S>
HWY_ATTR HWY_INLINE unsigned near_box(const BoxBlock<S>& block, const BasicAabb<S>& box, const NearWindow<S>& window,
                                      S* HWY_RESTRICT squared) {
  const hn::CappedTag<S, BoxBlock<S>::width> d;
  const auto zero = hn::Zero(d);
  unsigned near = 0;
  for (std::size_t i = 0; i < BoxBlock<S>::width; i += hn::Lanes(d)) {
    auto least = zero;
    auto most = zero;
    for (int k = 0; k < 3; ++k) {
      const auto lo = hn::Load(d, block.lo[k] + i), hi = hn::Load(d, block.hi[k] + i);
      const auto box_lo = hn::Set(d, box.min[k]), box_hi = hn::Set(d, box.max[k]);
      const auto gap = larger(hn::Sub(box_lo, hi), larger(hn::Sub(lo, box_hi), zero));
      least = hn::Add(least, hn::Mul(gap, gap));
      if constexpr (!Leaf) {
        const auto span = larger(hn::Sub(hi, box_lo), hn::Sub(box_hi, lo));
        most = hn::Add(most, hn::Mul(span, span));
      }
    }
    hn::StoreU(least, d, squared + i);
    const auto is_box = hn::Le(hn::Load(d, block.lo[0] + i), hn::Load(d, block.hi[0] + i));
    const auto is_inside = hn::Lt(Leaf ? least : most, hn::Set(d, window.inner));
    const auto in = hn::AndNot(is_inside, hn::And(is_box, hn::Le(least, hn::Set(d, window.reach))));
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, in, bits);
    near |= unsigned{bits[0]} << i;
  }
  return near;
}

template <class S>
HWY_ATTR HWY_INLINE std::uint64_t near_block(const BoxBlock<S>& HWY_RESTRICT a, const BoxBlock<S>& HWY_RESTRICT b,
                                             const NearWindow<S>& window, S* HWY_RESTRICT squared) {
  constexpr std::size_t width = BoxBlock<S>::width;
  const hn::CappedTag<S, width> d;
  const auto zero = hn::Zero(d);
  const auto reach = hn::Set(d, window.reach), inner = hn::Set(d, window.inner);
  std::uint64_t near = 0;
  for (std::size_t j = 0; j < width; j += hn::Lanes(d)) {
    const auto is_box = hn::Le(hn::Load(d, b.lo[0] + j), hn::Load(d, b.hi[0] + j));
    for (std::size_t i = 0; i < width; ++i) {
      if (!(a.lo[0][i] <= a.hi[0][i])) continue;
      auto least = zero;
      for (int k = 0; k < 3; ++k) {
        const auto lo = hn::Load(d, b.lo[k] + j), hi = hn::Load(d, b.hi[k] + j);
        const auto gap = larger(hn::Sub(hn::Set(d, a.lo[k][i]), hi), larger(hn::Sub(lo, hn::Set(d, a.hi[k][i])), zero));
        least = hn::Add(least, hn::Mul(gap, gap));
      }
      hn::StoreU(least, d, squared + width * i + j);
      const auto in = hn::AndNot(hn::Lt(least, inner), hn::And(is_box, hn::Le(least, reach)));
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, in, bits);
      near |= std::uint64_t{bits[0]} << (width * i + j);
    }
  }
  return near;
}

HWY_ATTR unsigned Node32(const BoxBlock<float>& block, const Aabb& box, const NearWindow<float>& window,
                         float* squared) {
  return near_box<false>(block, box, window, squared);
}
HWY_ATTR unsigned Node64(const BoxBlock<double>& block, const Aabb64& box, const NearWindow<double>& window,
                         double* squared) {
  return near_box<false>(block, box, window, squared);
}
HWY_ATTR unsigned Leaf32(const BoxBlock<float>& block, const Aabb& box, const NearWindow<float>& window,
                         float* squared) {
  return near_box<true>(block, box, window, squared);
}
HWY_ATTR unsigned Leaf64(const BoxBlock<double>& block, const Aabb64& box, const NearWindow<double>& window,
                         double* squared) {
  return near_box<true>(block, box, window, squared);
}
HWY_ATTR std::uint64_t Leaves32(const BoxBlock<float>& a, const BoxBlock<float>& b, const NearWindow<float>& window,
                                float* squared) {
  return near_block(a, b, window, squared);
}
HWY_ATTR std::uint64_t Leaves64(const BoxBlock<double>& a, const BoxBlock<double>& b, const NearWindow<double>& window,
                                double* squared) {
  return near_block(a, b, window, squared);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Node32);
HWY_EXPORT(Node64);
HWY_EXPORT(Leaf32);
HWY_EXPORT(Leaf64);
HWY_EXPORT(Leaves32);
HWY_EXPORT(Leaves64);

unsigned lanes_near(const BoxBlock<float>& block, const Aabb& box, const NearWindow<float>& window, float* squared) {
  return HWY_DYNAMIC_DISPATCH(Node32)(block, box, window, squared);
}
unsigned lanes_near(const BoxBlock<double>& block, const Aabb64& box, const NearWindow<double>& window,
                    double* squared) {
  return HWY_DYNAMIC_DISPATCH(Node64)(block, box, window, squared);
}
unsigned leaf_lanes_near(const BoxBlock<float>& block, const Aabb& box, const NearWindow<float>& window,
                         float* squared) {
  return HWY_DYNAMIC_DISPATCH(Leaf32)(block, box, window, squared);
}
unsigned leaf_lanes_near(const BoxBlock<double>& block, const Aabb64& box, const NearWindow<double>& window,
                         double* squared) {
  return HWY_DYNAMIC_DISPATCH(Leaf64)(block, box, window, squared);
}
std::uint64_t leaf_lanes_near(const BoxBlock<float>& a, const BoxBlock<float>& b, const NearWindow<float>& window,
                              float* squared) {
  return HWY_DYNAMIC_DISPATCH(Leaves32)(a, b, window, squared);
}
std::uint64_t leaf_lanes_near(const BoxBlock<double>& a, const BoxBlock<double>& b, const NearWindow<double>& window,
                              double* squared) {
  return HWY_DYNAMIC_DISPATCH(Leaves64)(a, b, window, squared);
}

}  // namespace boxstream::detail
#endif
