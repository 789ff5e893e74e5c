// SPDX-License-Identifier: MIT
#include "world/fat_boxes/fat_boxes_simd.hpp"

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/fat_boxes/fat_boxes_simd.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Without branches: the outcome is hard to predict.
template <class S>
HWY_INLINE bool share_a_point(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  bool share = true;
  for (int d = 0; d < 3; ++d) share = share & (a.min[d] <= b.max[d]) & (b.min[d] <= a.max[d]);
  return share;
}

template <class S>
HWY_INLINE bool is_between(const BasicAabb<S>& core, const BasicAabb<S>& fat_box, const BasicAabb<S>& box) {
  bool between = true;
  for (int d = 0; d < 3; ++d)
    between = between & (fat_box.min[d] <= box.min[d]) & (box.min[d] <= core.min[d]) & (core.max[d] <= box.max[d]) &
              (box.max[d] <= fat_box.max[d]);
  return between;
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

/// True for the first three lanes of one and the last three of the other.
HWY_INLINE bool all_true(hn::Mask<F> lower, hn::Mask<F> upper) {
  const F d;
  return hn::AllTrue(d, hn::And(hn::Or(lower, hn::Not(hn::FirstN(d, 3))), hn::Or(upper, hn::FirstN(d, 1))));
}

HWY_INLINE bool share_a_point(const Aabb& a, const Aabb& b) {
  const F d;
  const auto mask = hn::And(hn::Le(lower(a), hn::Shuffle0321(upper(b))), hn::Le(lower(b), hn::Shuffle0321(upper(a))));
  return hn::AllTrue(d, hn::Or(mask, hn::Not(hn::FirstN(d, 3))));
}

HWY_INLINE bool is_between(const Aabb& core, const Aabb& fat_box, const Aabb& box) {
  const auto low = lower(box), high = upper(box);
  return all_true(hn::And(hn::Le(lower(fat_box), low), hn::Le(low, lower(core))),
                  hn::And(hn::Le(high, upper(fat_box)), hn::Le(upper(core), high)));
}

HWY_INLINE bool is_between(const Aabb& core, const Aabb& fat_box, const Aabb& box, const float* drift) {
  const F d;
  const auto inf = hn::Set(d, std::numeric_limits<float>::infinity());
  const auto low_drift = hn::LoadU(d, drift), high_drift = hn::LoadU(d, drift - 1);
  const auto beyond = [&](hn::Vec<F> end, hn::Vec<F> drifts, hn::Vec<F> bound)
                          HWY_ATTR { return hn::Or(hn::Lt(hn::Add(end, drifts), bound), hn::Eq(end, hn::Neg(inf))); };
  const auto short_of = [&](hn::Vec<F> bound, hn::Vec<F> end, hn::Vec<F> drifts)
                            HWY_ATTR { return hn::Or(hn::Lt(bound, hn::Add(end, drifts)), hn::Eq(end, inf)); };
  const auto low = lower(box), high = upper(box);
  return all_true(hn::And(beyond(lower(fat_box), low_drift, low), short_of(low, lower(core), low_drift)),
                  hn::And(short_of(high, upper(fat_box), high_drift), beyond(upper(core), high_drift, high)));
}
#endif

template <class S>
HWY_INLINE bool is_between(const BasicAabb<S>& core, const BasicAabb<S>& fat_box, const BasicAabb<S>& box,
                           const S* drift) {
  constexpr S inf = std::numeric_limits<S>::infinity();
  const auto beyond = [&](S end, int d, S bound) HWY_ATTR { return (end + drift[d] < bound) | (end == -inf); };
  const auto short_of = [&](S bound, S end, int d) HWY_ATTR { return (bound < end + drift[d]) | (end == inf); };
  bool between = true;
  for (int d = 0; d < 3; ++d)
    between = between & beyond(fat_box.min[d], d, box.min[d]) & short_of(box.min[d], core.min[d], d) &
              beyond(core.max[d], d, box.max[d]) & short_of(box.max[d], fat_box.max[d], d);
  return between;
}

// Boxes are prefetched this many candidates ahead.
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
HWY_ATTR CandidateCounts candidates_of(const BasicAabb<S>* HWY_RESTRICT boxes, const BasicAabb<S>* HWY_RESTRICT cores,
                                       const Pair* HWY_RESTRICT pairs, std::size_t count,
                                       std::uint64_t* HWY_RESTRICT recheck, std::uint64_t* HWY_RESTRICT sure,
                                       Pair* HWY_RESTRICT overlapping) {
  CandidateCounts counts;
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = pairs[i];
    const Pair soon = pairs[i + ahead < count ? i + ahead : i];
    hwy::Prefetch(boxes + soon.a);
    hwy::Prefetch(boxes + soon.b);
    const bool overlap = share_a_point(boxes[pair.a], boxes[pair.b]);
    const bool is_sure = cores != nullptr && share_a_point(cores[pair.a], cores[pair.b]);
    const std::uint64_t candidate = std::uint64_t{pair.a} << 33 | std::uint64_t{pair.b} << 1 | (overlap ? 1 : 0);
    recheck[counts.recheck] = sure[counts.sure] = candidate;
    counts.recheck += !is_sure;
    counts.sure += is_sure;
    overlapping[counts.overlapping] = pair;
    counts.overlapping += overlap;
  }
  return counts;
}

template <class S>
HWY_ATTR std::size_t overlapping_of(const BasicAabb<S>* HWY_RESTRICT fat_boxes, std::size_t count,
                                    const BasicAabb<S>& fat_box, std::uint32_t* HWY_RESTRICT overlapping) {
  std::size_t found = 0;
  for (std::size_t i = 0; i < count; ++i) {
    overlapping[found] = static_cast<std::uint32_t>(i);
    found += share_a_point(fat_boxes[i], fat_box);
  }
  return found;
}

template <class S>
HWY_ATTR std::size_t outside_of(const BasicAabb<S>* HWY_RESTRICT fat_boxes, const BasicAabb<S>* HWY_RESTRICT cores,
                                const BasicAabb<S>* HWY_RESTRICT boxes, std::size_t count, const S* HWY_RESTRICT drift,
                                std::uint32_t* HWY_RESTRICT outside) {
  std::size_t found = 0;
  constexpr S inf = std::numeric_limits<S>::infinity();
  constexpr BasicAabb<S> none{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (std::size_t i = 0; i < count; ++i) {
    const BasicAabb<S>& core = cores == nullptr ? none : cores[i];
    outside[found] = static_cast<std::uint32_t>(i);
    found += !(drift == nullptr ? is_between(core, fat_boxes[i], boxes[i])
                                : is_between(core, fat_boxes[i], boxes[i], drift));
  }
  return found;
}

#define BOXSTREAM_FAT_BOX_LOOPS(S, bits)                                                                            \
  HWY_ATTR std::size_t FindChanged##bits(const BasicAabb<S>* boxes, const std::uint64_t* candidates, std::size_t n, \
                                         std::uint32_t* changed) {                                                  \
    return changed_of(boxes, candidates, n, changed);                                                               \
  }                                                                                                                 \
  HWY_ATTR CandidateCounts MakeCandidates##bits(const BasicAabb<S>* boxes, const BasicAabb<S>* cores,               \
                                                const Pair* pairs, std::size_t n, std::uint64_t* recheck,           \
                                                std::uint64_t* sure, Pair* overlapping) {                           \
    return candidates_of(boxes, cores, pairs, n, recheck, sure, overlapping);                                       \
  }                                                                                                                 \
  HWY_ATTR std::size_t FindOverlapping##bits(const BasicAabb<S>* fat_boxes, std::size_t n,                          \
                                             const BasicAabb<S>& fat_box, std::uint32_t* overlapping) {             \
    return overlapping_of(fat_boxes, n, fat_box, overlapping);                                                      \
  }                                                                                                                 \
  HWY_ATTR std::size_t FindOutside##bits(const BasicAabb<S>* fat_boxes, const BasicAabb<S>* cores,                  \
                                         const BasicAabb<S>* boxes, std::size_t n, const S* drift,                  \
                                         std::uint32_t* outside) {                                                  \
    return outside_of(fat_boxes, cores, boxes, n, drift, outside);                                                  \
  }
BOXSTREAM_FAT_BOX_LOOPS(float, 32)
BOXSTREAM_FAT_BOX_LOOPS(double, 64)
#undef BOXSTREAM_FAT_BOX_LOOPS

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

#define BOXSTREAM_FAT_BOX_LOOPS(S, bits)                                                                           \
  HWY_EXPORT(FindChanged##bits);                                                                                   \
  HWY_EXPORT(MakeCandidates##bits);                                                                                \
  HWY_EXPORT(FindOverlapping##bits);                                                                               \
  HWY_EXPORT(FindOutside##bits);                                                                                   \
  std::size_t find_changed(const BasicAabb<S>* boxes, const std::uint64_t* candidates, std::size_t n,              \
                           std::uint32_t* changed) {                                                               \
    return HWY_DYNAMIC_DISPATCH(FindChanged##bits)(boxes, candidates, n, changed);                                 \
  }                                                                                                                \
  CandidateCounts make_candidates(const BasicAabb<S>* boxes, const BasicAabb<S>* cores, const Pair* pairs,         \
                                  std::size_t n, std::uint64_t* recheck, std::uint64_t* sure, Pair* overlapping) { \
    return HWY_DYNAMIC_DISPATCH(MakeCandidates##bits)(boxes, cores, pairs, n, recheck, sure, overlapping);         \
  }                                                                                                                \
  std::size_t find_overlapping(const BasicAabb<S>* fat_boxes, std::size_t n, const BasicAabb<S>& fat_box,          \
                               std::uint32_t* overlapping) {                                                       \
    return HWY_DYNAMIC_DISPATCH(FindOverlapping##bits)(fat_boxes, n, fat_box, overlapping);                        \
  }                                                                                                                \
  std::size_t find_outside(const BasicAabb<S>* fat_boxes, const BasicAabb<S>* cores, const BasicAabb<S>* boxes,    \
                           std::size_t n, const S* drift, std::uint32_t* outside) {                                \
    return HWY_DYNAMIC_DISPATCH(FindOutside##bits)(fat_boxes, cores, boxes, n, drift, outside);                    \
  }
BOXSTREAM_FAT_BOX_LOOPS(float, 32)
BOXSTREAM_FAT_BOX_LOOPS(double, 64)
#undef BOXSTREAM_FAT_BOX_LOOPS

}  // namespace boxstream::detail
#endif
