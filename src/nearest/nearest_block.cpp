// SPDX-License-Identifier: MIT
#include "nearest/nearest_block.hpp"

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "nearest/nearest_block.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "nearest/nearest_block-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

template <class D>
HWY_ATTR HWY_INLINE unsigned mask_bits(D d, hn::Mask<D> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// Bit i: lane `first` + i of `block`, with the box given by six numbers.
template <class D, class S>
HWY_ATTR HWY_INLINE unsigned near_lanes(D d, const BoxBlock<S>& HWY_RESTRICT block, std::size_t first, const S (&lo)[3],
                                        const S (&hi)[3], S reach, S* HWY_RESTRICT squared) {
  const auto sum = squared_distances(d, block, first, lo, hi);
  hn::StoreU(sum, d, squared);
  return mask_bits(d, hn::And(filled_lanes(d, block, first), hn::Le(sum, hn::Set(d, reach))));
}

template <class S>
HWY_ATTR HWY_INLINE unsigned near_box(const BoxBlock<S>& block, const BasicAabb<S>& box, S reach, S* squared) {
  const hn::CappedTag<S, BoxBlock<S>::width> d;
  unsigned near = 0;
  for (std::size_t j = 0; j < BoxBlock<S>::width; j += hn::Lanes(d))
    near |= near_lanes(d, block, j, box.min, box.max, reach, squared + j) << j;
  return near;
}

template <class S>
HWY_ATTR HWY_INLINE std::uint64_t near_boxes(const BoxBlock<S>* blocks, std::size_t count, const BasicAabb<S>& of,
                                             S reach, S* squared) {
  constexpr std::size_t width = BoxBlock<S>::width;
  const BasicAabb<S> box = of;
  std::uint64_t near = 0;
  for (std::size_t i = 0; i < count; ++i)
    near |= std::uint64_t{near_box(blocks[i], box, reach, squared + width * i)} << (width * i);
  return near;
}

template <class S>
HWY_ATTR HWY_INLINE std::uint64_t near_block(const BoxBlock<S>& a, const BoxBlock<S>& b,
                                             const BasicAabb<S>& bounds_of_b, S reach, S* squared) {
  constexpr unsigned width = BoxBlock<S>::width;
  std::uint64_t near = 0;
  // Blocks that are near each other often have few lanes near the other one.
  for (unsigned rest = near_box(a, bounds_of_b, reach, squared); rest != 0; rest &= rest - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    near |= std::uint64_t{near_box(b, a.get(i), reach, squared + width * i)} << (width * i);
  }
  return near;
}

template <class S>
HWY_ATTR HWY_INLINE std::uint64_t near_within(const BoxBlock<S>& block, S reach, unsigned& first, S* squared) {
  constexpr unsigned width = BoxBlock<S>::width;
  const hn::CappedTag<S, width> d;
  const auto lanes = static_cast<unsigned>(hn::Lanes(d));
  unsigned filled = 0;
  for (unsigned j = 0; j < width; j += lanes) filled |= mask_bits(d, filled_lanes(d, block, j)) << j;
  const auto most = hn::Set(d, reach);
  std::uint64_t near = 0;
  const bool has_limit = reach < std::numeric_limits<S>::infinity();
  unsigned rest = filled & (~0u << first);
  first = width;
  for (unsigned above = rest & (rest - 1); above != 0; rest = above, above &= above - 1) {
    const auto i = static_cast<unsigned>(std::countr_zero(rest));
    const S lo[3] = {block.lo[0][i], block.lo[1][i], block.lo[2][i]};
    const S hi[3] = {block.hi[0][i], block.hi[1][i], block.hi[2][i]};
    unsigned row = 0, touching = 0;
    for (unsigned j = (i + 1) & ~(lanes - 1); j < width && above >> j != 0; j += lanes) {
      const auto sum = squared_distances(d, block, j, lo, hi);
      hn::StoreU(sum, d, squared + width * i + j);
      row |= mask_bits(d, hn::Le(sum, most)) << j;
      if (!has_limit) touching |= mask_bits(d, hn::Le(sum, hn::Zero(d))) << j;
    }
    near |= std::uint64_t{row & above} << (width * i);
    if ((touching & above) == 0) continue;
    first = i + 1;
    break;
  }
  return near;
}

HWY_ATTR std::uint64_t Boxes32(const BoxBlock<float>* blocks, std::size_t count, const Aabb& box, float reach,
                               float* squared) {
  return near_boxes(blocks, count, box, reach, squared);
}
HWY_ATTR std::uint64_t Boxes64(const BoxBlock<double>* blocks, std::size_t count, const Aabb64& box, double reach,
                               double* squared) {
  return near_boxes(blocks, count, box, reach, squared);
}
HWY_ATTR std::uint64_t Block32(const BoxBlock<float>& a, const BoxBlock<float>& b, const Aabb& bounds_of_b, float reach,
                               float* squared) {
  return near_block(a, b, bounds_of_b, reach, squared);
}
HWY_ATTR std::uint64_t Block64(const BoxBlock<double>& a, const BoxBlock<double>& b, const Aabb64& bounds_of_b,
                               double reach, double* squared) {
  return near_block(a, b, bounds_of_b, reach, squared);
}

HWY_ATTR std::uint64_t Within32(const BoxBlock<float>& block, float reach, unsigned& first, float* squared) {
  return near_within(block, reach, first, squared);
}
HWY_ATTR std::uint64_t Within64(const BoxBlock<double>& block, double reach, unsigned& first, double* squared) {
  return near_within(block, reach, first, squared);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Boxes32);
HWY_EXPORT(Boxes64);
HWY_EXPORT(Block32);
HWY_EXPORT(Block64);
HWY_EXPORT(Within32);
HWY_EXPORT(Within64);

std::uint64_t lanes_near(const BoxBlock<float>* blocks, std::size_t count, const Aabb& box, float reach,
                         float* squared) {
  return HWY_DYNAMIC_DISPATCH(Boxes32)(blocks, count, box, reach, squared);
}
std::uint64_t lanes_near(const BoxBlock<double>* blocks, std::size_t count, const Aabb64& box, double reach,
                         double* squared) {
  return HWY_DYNAMIC_DISPATCH(Boxes64)(blocks, count, box, reach, squared);
}
std::uint64_t lanes_near(const BoxBlock<float>& a, const BoxBlock<float>& b, const Aabb& bounds_of_b, float reach,
                         float* squared) {
  return HWY_DYNAMIC_DISPATCH(Block32)(a, b, bounds_of_b, reach, squared);
}
std::uint64_t lanes_near(const BoxBlock<double>& a, const BoxBlock<double>& b, const Aabb64& bounds_of_b, double reach,
                         double* squared) {
  return HWY_DYNAMIC_DISPATCH(Block64)(a, b, bounds_of_b, reach, squared);
}
std::uint64_t lanes_near_each_other(const BoxBlock<float>& block, float reach, unsigned& first, float* squared) {
  return HWY_DYNAMIC_DISPATCH(Within32)(block, reach, first, squared);
}
std::uint64_t lanes_near_each_other(const BoxBlock<double>& block, double reach, unsigned& first, double* squared) {
  return HWY_DYNAMIC_DISPATCH(Within64)(block, reach, first, squared);
}

}  // namespace boxstream::detail
#endif
