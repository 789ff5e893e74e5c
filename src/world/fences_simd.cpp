// SPDX-License-Identifier: MIT
#include "world/fences_simd.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/fences_simd.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// No branches: most candidates overlap, some do not, and which is hard to predict.
template <class S>
HWY_INLINE bool share_a_point(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  bool share = true;
  for (int d = 0; d < 3; ++d) share = share & (a.min[d] <= b.max[d]) & (b.min[d] <= a.max[d]);
  return share;
}

template <class S>
HWY_INLINE bool is_inside(const BasicAabb<S>& fence, const BasicAabb<S>& box) {
  bool inside = true;
  for (int d = 0; d < 3; ++d) inside = inside & (fence.min[d] <= box.min[d]) & (box.max[d] <= fence.max[d]);
  return inside;
}

#if HWY_TARGET != HWY_SCALAR
using F = hn::FixedTag<float, 4>;

// The six bounds as two vectors that overlap: three lower ones and an upper one, a lower one and three upper ones.
HWY_INLINE hn::Vec<F> lower(const Aabb& box) {
  return hn::LoadU(F(), box.min);
}
HWY_INLINE hn::Vec<F> upper(const Aabb& box) {
  return hn::LoadU(F(), box.min + 2);
}

HWY_INLINE unsigned bits_of(hn::Mask<F> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(F(), mask, bits);
  return bits[0];
}

HWY_INLINE bool share_a_point(const Aabb& a, const Aabb& b) {
  const auto mask = hn::And(hn::Le(lower(a), hn::Shuffle0321(upper(b))), hn::Le(lower(b), hn::Shuffle0321(upper(a))));
  return (bits_of(mask) & 7) == 7;
}

HWY_INLINE bool is_inside(const Aabb& fence, const Aabb& box) {
  const unsigned low = bits_of(hn::Le(lower(fence), lower(box))), high = bits_of(hn::Le(upper(box), upper(fence)));
  return ((low | 8) & (high | 1)) == 15;
}

HWY_INLINE bool is_inside(const Aabb& fence, const Aabb& box, const float* drift) {
  const F d;
  const auto inf = hn::Set(d, std::numeric_limits<float>::infinity());
  const auto low = lower(fence), high = upper(fence);
  const auto low_drift = hn::LoadU(d, drift);
  const auto high_drift = hn::LoadU(d, drift - 1);
  const auto above = hn::Or(hn::Lt(hn::Add(low, low_drift), lower(box)), hn::Eq(low, hn::Neg(inf)));
  const auto below = hn::Or(hn::Lt(upper(box), hn::Add(high, high_drift)), hn::Eq(high, inf));
  return ((bits_of(above) | 8) & (bits_of(below) | 1)) == 15;
}
#endif

template <class S>
HWY_INLINE bool is_inside(const BasicAabb<S>& fence, const BasicAabb<S>& box, const S* drift) {
  constexpr S inf = std::numeric_limits<S>::infinity();
  bool inside = true;
  for (int d = 0; d < 3; ++d)
    inside = inside & ((fence.min[d] + drift[d] < box.min[d]) | (fence.min[d] == -inf)) &
             ((box.max[d] < fence.max[d] + drift[d]) | (fence.max[d] == inf));
  return inside;
}

// Boxes are asked for so many candidates before they are needed.
constexpr std::size_t ahead = 32;

template <class S>
HWY_ATTR std::size_t changed_of(const BasicAabb<S>* HWY_RESTRICT boxes, const std::uint64_t* HWY_RESTRICT candidates,
                                std::size_t count, std::uint32_t* HWY_RESTRICT changed) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint64_t candidate = candidates[i];
    const std::uint64_t soon = candidates[i + ahead < count ? i + ahead : i];
    hwy::Prefetch(boxes + (soon >> 33));
    hwy::Prefetch(boxes + (soon >> 1 & 0xffffffff));
    const bool is_held = (candidate & 1) != 0;
    changed[found] = static_cast<std::uint32_t>(i);
    found += share_a_point(boxes[candidate >> 33], boxes[candidate >> 1 & 0xffffffff]) != is_held;
  }
  return found;
}

template <class S>
HWY_ATTR std::size_t candidates_of(const BasicAabb<S>* HWY_RESTRICT boxes, const Pair* HWY_RESTRICT pairs,
                                   std::size_t count, std::uint64_t* HWY_RESTRICT candidates,
                                   Pair* HWY_RESTRICT overlapping) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = pairs[i];
    const Pair soon = pairs[i + ahead < count ? i + ahead : i];
    hwy::Prefetch(boxes + soon.a);
    hwy::Prefetch(boxes + soon.b);
    const bool overlap = share_a_point(boxes[pair.a], boxes[pair.b]);
    candidates[i] = std::uint64_t{pair.a} << 33 | std::uint64_t{pair.b} << 1 | (overlap ? 1 : 0);
    overlapping[found] = pair;
    found += overlap;
  }
  return found;
}

template <class S>
HWY_ATTR std::size_t overlapping_of(const BasicAabb<S>* HWY_RESTRICT fences, std::size_t count,
                                    const BasicAabb<S>& fence, std::uint32_t* HWY_RESTRICT overlapping) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    overlapping[found] = static_cast<std::uint32_t>(i);
    found += share_a_point(fences[i], fence);
  }
  return found;
}

template <class S>
HWY_ATTR std::size_t outside_of(const BasicAabb<S>* HWY_RESTRICT fences, const BasicAabb<S>* HWY_RESTRICT boxes,
                                std::size_t count, const S* HWY_RESTRICT drift, std::uint32_t* HWY_RESTRICT outside) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    outside[found] = static_cast<std::uint32_t>(i);
    found += !(drift == nullptr ? is_inside(fences[i], boxes[i]) : is_inside(fences[i], boxes[i], drift));
  }
  return found;
}

#define BOXSTREAM_FENCE_LOOPS(S, bits)                                                                              \
  HWY_ATTR std::size_t FindChanged##bits(const BasicAabb<S>* boxes, const std::uint64_t* candidates, std::size_t n, \
                                         std::uint32_t* changed) {                                                  \
    return changed_of(boxes, candidates, n, changed);                                                               \
  }                                                                                                                 \
  HWY_ATTR std::size_t MakeCandidates##bits(const BasicAabb<S>* boxes, const Pair* pairs, std::size_t n,            \
                                            std::uint64_t* candidates, Pair* overlapping) {                         \
    return candidates_of(boxes, pairs, n, candidates, overlapping);                                                 \
  }                                                                                                                 \
  HWY_ATTR std::size_t FindOverlapping##bits(const BasicAabb<S>* fences, std::size_t n, const BasicAabb<S>& fence,  \
                                             std::uint32_t* overlapping) {                                          \
    return overlapping_of(fences, n, fence, overlapping);                                                           \
  }                                                                                                                 \
  HWY_ATTR std::size_t FindOutside##bits(const BasicAabb<S>* fences, const BasicAabb<S>* boxes, std::size_t n,      \
                                         const S* drift, std::uint32_t* outside) {                                  \
    return outside_of(fences, boxes, n, drift, outside);                                                            \
  }
BOXSTREAM_FENCE_LOOPS(float, 32)
BOXSTREAM_FENCE_LOOPS(double, 64)
#undef BOXSTREAM_FENCE_LOOPS

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

#define BOXSTREAM_FENCE_LOOPS(S, bits)                                                                                \
  HWY_EXPORT(FindChanged##bits);                                                                                      \
  HWY_EXPORT(MakeCandidates##bits);                                                                                   \
  HWY_EXPORT(FindOverlapping##bits);                                                                                  \
  HWY_EXPORT(FindOutside##bits);                                                                                      \
  std::size_t find_changed(const BasicAabb<S>* boxes, const std::uint64_t* candidates, std::size_t n,                 \
                           std::uint32_t* changed) {                                                                  \
    return HWY_DYNAMIC_DISPATCH(FindChanged##bits)(boxes, candidates, n, changed);                                    \
  }                                                                                                                   \
  std::size_t make_candidates(const BasicAabb<S>* boxes, const Pair* pairs, std::size_t n, std::uint64_t* candidates, \
                              Pair* overlapping) {                                                                    \
    return HWY_DYNAMIC_DISPATCH(MakeCandidates##bits)(boxes, pairs, n, candidates, overlapping);                      \
  }                                                                                                                   \
  std::size_t find_overlapping(const BasicAabb<S>* fences, std::size_t n, const BasicAabb<S>& fence,                  \
                               std::uint32_t* overlapping) {                                                          \
    return HWY_DYNAMIC_DISPATCH(FindOverlapping##bits)(fences, n, fence, overlapping);                                \
  }                                                                                                                   \
  std::size_t find_outside(const BasicAabb<S>* fences, const BasicAabb<S>* boxes, std::size_t n, const S* drift,      \
                           std::uint32_t* outside) {                                                                  \
    return HWY_DYNAMIC_DISPATCH(FindOutside##bits)(fences, boxes, n, drift, outside);                                 \
  }
BOXSTREAM_FENCE_LOOPS(float, 32)
BOXSTREAM_FENCE_LOOPS(double, 64)
#undef BOXSTREAM_FENCE_LOOPS

}  // namespace boxstream::detail
#endif
