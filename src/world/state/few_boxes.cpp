// SPDX-License-Identifier: MIT
//
// Few boxes compared with one. Compiled once per SIMD target; the best one for the machine is picked at run time.
#include "world/state/few_boxes.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "world/state/few_boxes.cpp"
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "batch/records/columns_load-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

#if (HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX3_DL) && (HWY_TARGETS & HWY_AVX2) != 0

// Where masks are no vectors, to combine them takes longer than to compare: as in batch/front/small.cpp.
using N_AVX2::Hits32;
using N_AVX2::Hits64;
using N_AVX2::Load32;
using N_AVX2::Load64;
using N_AVX2::Row32;
using N_AVX2::Row64;
using N_AVX2::Rows32;
using N_AVX2::Rows64;
using N_AVX2::Touching32;
using N_AVX2::Touching64;

#else

template <class S>
HWY_INLINE void load_lanes(const BasicAabb<S>* boxes, std::size_t size, std::size_t first, std::size_t end,
                           const FewColumns<decltype(order_key(S()))>& out) {
  using Key = decltype(order_key(S()));
  const Narrow<Key> d;
  constexpr std::size_t step = hn::MaxLanes(d);
  for (std::size_t at = first / step * step; at < end; at += step) {
    hn::VFromD<Narrow<Key> > bounds[6];
    const std::size_t count = std::min(step, size - at);
    deinterleave_few(d, boxes + at, count - 1, bounds);
    store_keys(d, bounds, count, at, Faces::closed, out);
  }
}

/// Bits of the lanes from `at` on, up to `end`, that meet `one`, in the word that they are in. Columns are by value,
/// for what is written could be theirs.
template <class Key>
HWY_INLINE std::uint64_t word_of(FewColumns<Key> columns, const Bounds<Narrow<Key> >& one, std::size_t at,
                                 std::size_t end) {
  constexpr std::size_t step = hn::MaxLanes(Narrow<Key>());
  std::uint64_t meeting = 0;
  for (; at < end; at += step) {
    Bounds<Narrow<Key> > many;
    many.load(columns, at);
    meeting |= std::uint64_t{bits_of(Narrow<Key>(), one.disjoint(many)) ^ ((1u << step) - 1)} << at % 64;
  }
  return meeting;
}

template <class Key>
HWY_INLINE void touching(const FewColumns<Key>& columns, const Bounds<Narrow<Key> >& one, std::size_t size,
                         std::uint64_t* bits) {
  for (std::size_t at = 0; at < size; at += 64) *bits++ = word_of(columns, one, at, std::min(size, at + 64));
}

template <class S>
HWY_INLINE auto bounds_of(const BoxKeys<S>& box) {
  const Narrow<decltype(order_key(S()))> d;
  Bounds<Narrow<decltype(order_key(S()))> > bounds;
  for (int axis = 0; axis < 3; ++axis) {
    bounds.lo[axis] = hn::Set(d, box.lo(axis));
    bounds.hi[axis] = hn::Set(d, box.hi(axis));
  }
  return bounds;
}

template <class Key>
HWY_INLINE void row(const FewColumns<Key>& columns, std::uint32_t rank, std::size_t size, std::uint64_t* bits) {
  Bounds<Narrow<Key> > one;
  one.repeat(columns, rank);
  touching(columns, one, size, bits);
}

template <class Key>
HWY_INLINE void rows(const FewColumns<Key>& columns, std::size_t size, std::uint64_t* bits) {
  constexpr std::size_t step = hn::MaxLanes(Narrow<Key>());
  const std::size_t words = (size + 63) / 64;
  for (std::size_t i = 0; i < size; ++i) {
    Bounds<Narrow<Key> > one;
    one.repeat(columns, i);
    std::size_t at = i / step * step;
    for (std::size_t w = i / 64; w < words; ++w, at = 64 * w)
      bits[i * words + w] = word_of(columns, one, at, std::min(size, 64 * w + 64));
  }
}

/// Keys to numbers.
template <class S, class DK>
HWY_INLINE hn::VFromD<hn::Rebind<S, DK> > number_of(DK d, const hn::TFromD<DK>* keys) {
  const hn::RebindToUnsigned<DK> du;
  const auto key = hn::Load(d, keys);
  const auto but_sign = hn::ShiftRight<1>(hn::BitCast(du, hn::BroadcastSignBit(key)));
  return hn::BitCast(hn::Rebind<S, DK>(), hn::Xor(key, hn::BitCast(d, but_sign)));
}

/// And back, but for -0, of which it makes less than 0.
template <class DS>
HWY_INLINE auto key_of(DS, hn::VFromD<DS> number) {
  const hn::RebindToSigned<DS> d;
  const hn::RebindToUnsigned<DS> du;
  const auto bits = hn::BitCast(d, number);
  const auto but_sign = hn::ShiftRight<1>(hn::BitCast(du, hn::BroadcastSignBit(bits)));
  return hn::Xor(bits, hn::BitCast(d, but_sign));
}

/// A box that meets each box that a ray which `is_plain` meets: all its points, and more than tests of it round.
template <class S>
HWY_INLINE auto swept(const RaySlabs<S>& ray) {
  using Key = decltype(order_key(S()));
  const hn::Rebind<S, Narrow<Key> > ds;
  const auto rounding = hn::Set(ds, 16 * std::numeric_limits<S>::epsilon());
  const auto length = hn::Set(ds, ray.length + std::numeric_limits<S>::min());
  Bounds<Narrow<Key> > box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto origin = hn::Set(ds, ray.origin[axis]), way = hn::Div(length, hn::Set(ds, ray.inverse[axis]));
    const auto reach_lo = hn::Set(ds, ray.reach_lo[axis]), reach_hi = hn::Set(ds, ray.reach_hi[axis]);
    const auto sizes = hn::Add(hn::Add(hn::Abs(origin), hn::Abs(way)), hn::Add(hn::Abs(reach_lo), hn::Abs(reach_hi)));
    const auto slack = hn::Mul(rounding, sizes);
    const auto least = hn::Add(origin, hn::Min(way, hn::Zero(ds))), most = hn::Add(origin, hn::Max(way, hn::Zero(ds)));
    box.lo[axis] = key_of(ds, hn::Sub(hn::Add(least, reach_hi), slack));
    box.hi[axis] = key_of(ds, hn::Add(hn::Add(most, reach_lo), slack));
  }
  return box;
}

/// A ray that `is_plain`, as vectors: no axis is special, and no time a NaN.
template <class S, bool has_reach>
class PlainSlabs {
  using Key = decltype(order_key(S()));
  using D = Narrow<Key>;
  using DS = hn::Rebind<S, D>;

 public:
  PlainSlabs(const FewColumns<Key>& columns, const RaySlabs<S>& ray)
      : first_lo_(columns.lo[0]), first_hi_(columns.hi[0]), length_(hn::Set(DS(), ray.length)) {
    for (int axis = 0; axis < 3; ++axis) {
      const bool backwards = ray.inverse[axis] < 0;
      near_[axis] = backwards ? columns.hi[axis] : columns.lo[axis];
      far_[axis] = backwards ? columns.lo[axis] : columns.hi[axis];
      near_reach_[axis] = backwards ? ray.reach_hi[axis] : ray.reach_lo[axis];
      far_reach_[axis] = backwards ? ray.reach_lo[axis] : ray.reach_hi[axis];
      origin_[axis] = hn::Set(DS(), ray.origin[axis]);
      inverse_[axis] = hn::Set(DS(), ray.inverse[axis]);
    }
  }

  /// As `missed`.
  HWY_INLINE std::uint64_t misses(std::size_t at, S* enters) const {
    const auto is_inert = hn::Gt(hn::Load(D(), first_lo_ + at), hn::Load(D(), first_hi_ + at));
    auto enter = hn::Zero(DS()), leave = length_;
    for (int axis = 0; axis < 3; ++axis) {
      auto near = number_of<S>(D(), near_[axis] + at), far = number_of<S>(D(), far_[axis] + at);
      if (axis == 0) {  // where inert lanes have no numbers, which would raise flags
        const auto inert = hn::VecFromMask(DS(), hn::RebindMask(DS(), is_inert));
        near = hn::AndNot(inert, near);
        far = hn::AndNot(inert, far);
      }
      enter = hn::Max(crossing(near, near_reach_[axis], axis), enter);
      leave = hn::Min(crossing(far, far_reach_[axis], axis), leave);
    }
    hn::StoreU(enter, DS(), enters + at);
    return bits_of(DS(), hn::Or(hn::RebindMask(DS(), is_inert), hn::Gt(enter, leave)));
  }

 private:
  HWY_INLINE hn::VFromD<DS> crossing(hn::VFromD<DS> bound, S reach, int axis) const {
    if constexpr (has_reach) bound = hn::Sub(bound, hn::Set(DS(), reach));
    return hn::Mul(hn::Sub(bound, origin_[axis]), inverse_[axis]);
  }

  const Key *first_lo_, *first_hi_, *near_[3], *far_[3];
  S near_reach_[3], far_reach_[3];
  hn::VFromD<DS> origin_[3], inverse_[3], length_;
};

/// Bits of the lanes from `at` on that the ray misses. As BoxBlock::hit.
template <class S>
HWY_INLINE std::uint64_t missed(const FewColumns<decltype(order_key(S()))>& columns, const RaySlabs<S>& ray,
                                std::size_t at, S* enters) {
  using Key = decltype(order_key(S()));
  const Narrow<Key> d;
  const hn::Rebind<S, Narrow<Key> > ds;
  const auto is_inert = hn::Gt(hn::Load(d, columns.lo[0] + at), hn::Load(d, columns.hi[0] + at));
  auto outside = hn::RebindMask(ds, is_inert);
  auto enter = hn::Zero(ds), leave = hn::Set(ds, ray.length);
  for (int axis = 0; axis < 3; ++axis) {
    const auto origin = hn::Set(ds, ray.origin[axis]);
    const auto lo = number_of<S>(d, columns.lo[axis] + at);
    const auto hi = number_of<S>(d, columns.hi[axis] + at);
    const auto below = hn::Sub(hn::Sub(lo, hn::Set(ds, ray.reach_lo[axis])), origin);
    const auto above = hn::Sub(hn::Sub(hi, hn::Set(ds, ray.reach_hi[axis])), origin);
    if (ray.parallel[axis]) {
      outside = hn::Or(outside, hn::Or(hn::Gt(below, hn::Zero(ds)), hn::Lt(above, hn::Zero(ds))));
      continue;
    }
    const auto inverse = hn::Set(ds, ray.inverse[axis]);
    const bool backwards = ray.inverse[axis] < 0;
    const auto t_near = hn::Mul(backwards ? above : below, inverse);
    const auto t_far = hn::Mul(backwards ? below : above, inverse);
    // A comparison with NaN (infinity minus itself, or times zero) is false and leaves the interval as it is.
    enter = hn::IfThenElse(hn::Gt(t_near, enter), t_near, enter);
    leave = hn::IfThenElse(hn::Lt(t_far, leave), t_far, leave);
  }
  hn::StoreU(enter, ds, enters + at);
  return bits_of(ds, hn::Or(outside, hn::Gt(enter, leave)));
}

/// Leaves those of the boxes in `bits` that the ray meets. `misses(at)` gives bits of the lanes from there on.
template <class Key, class Misses>
HWY_INLINE void leave_hits(std::size_t size, std::uint64_t* bits, Misses&& misses) {
  constexpr std::size_t step = hn::MaxLanes(Narrow<Key>());
  for (std::size_t at = 0; at < size; ++bits) {
    std::uint64_t word = *bits;
    for (const std::size_t end = std::min(size, at + 64); at < end; at += step)
      if ((word >> at % 64 & ((1u << step) - 1)) != 0) word &= ~(misses(at) << at % 64);
    *bits = word;
  }
}

template <class S>
HWY_INLINE void hits(const FewColumns<decltype(order_key(S()))>& columns, const RaySlabs<S>& ray, std::size_t size,
                     S* enters, std::uint64_t* bits) {
  using Key = decltype(order_key(S()));
  const auto leave_plain_hits = [&](const auto& plain) {
    leave_hits<Key>(size, bits, [&](std::size_t at) { return plain.misses(at, enters); });
  };
  // To compare with what is swept takes a fifth of a test, and spares most of them, for boxes seldom go far.
  constexpr std::size_t few = 16;
  const bool is_box = ray.is_plain && ray.has_reach();
  if (is_box && size > few)
    touching(columns, swept(ray), size, bits);
  else
    set_first(bits, size);
  if (!ray.is_plain)
    leave_hits<Key>(size, bits, [&](std::size_t at) { return missed(columns, ray, at, enters); });
  else if (is_box)
    leave_plain_hits(PlainSlabs<S, true>(columns, ray));
  else
    leave_plain_hits(PlainSlabs<S, false>(columns, ray));
}

#define BOXSTREAM_FEW_BOXES(S, K)                                                                                \
  HWY_ATTR void Load##K(const BasicAabb<S>* boxes, std::size_t size, std::size_t first, std::size_t end,         \
                        const FewColumns<std::int##K##_t>& out) {                                                \
    load_lanes(boxes, size, first, end, out);                                                                    \
  }                                                                                                              \
  HWY_ATTR void Touching##K(const FewColumns<std::int##K##_t>& columns, const BoxKeys<S>& box, std::size_t size, \
                            std::uint64_t* bits) {                                                               \
    touching(columns, bounds_of(box), size, bits);                                                               \
  }                                                                                                              \
  HWY_ATTR void Row##K(const FewColumns<std::int##K##_t>& columns, std::uint32_t rank, std::size_t size,         \
                       std::uint64_t* bits) {                                                                    \
    row(columns, rank, size, bits);                                                                              \
  }                                                                                                              \
  HWY_ATTR void Rows##K(const FewColumns<std::int##K##_t>& columns, std::size_t size, std::uint64_t* bits) {     \
    rows(columns, size, bits);                                                                                   \
  }                                                                                                              \
  HWY_ATTR void Hits##K(const FewColumns<std::int##K##_t>& columns, const RaySlabs<S>& ray, std::size_t size,    \
                        S* enters, std::uint64_t* bits) {                                                        \
    hits(columns, ray, size, enters, bits);                                                                      \
  }
BOXSTREAM_FEW_BOXES(float, 32)
BOXSTREAM_FEW_BOXES(double, 64)
#undef BOXSTREAM_FEW_BOXES

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(Load32);
HWY_EXPORT(Load64);
HWY_EXPORT(Touching32);
HWY_EXPORT(Touching64);
HWY_EXPORT(Row32);
HWY_EXPORT(Row64);
HWY_EXPORT(Rows32);
HWY_EXPORT(Rows64);
HWY_EXPORT(Hits32);
HWY_EXPORT(Hits64);

template <class S>
void FewBoxes<S>::resize(Span<const Box> boxes, std::size_t size) {
  assert(boxes.size() <= size && size <= most);
  const std::size_t lanes = lanes_of(size);
  std::vector<Key> keys(6 * lanes + line - 1);
  keys_.swap(keys);
  lanes_ = lanes;
  const auto misplaced = reinterpret_cast<std::uintptr_t>(keys_.data()) / sizeof(Key) % line;
  Key* const first = keys_.data() + (line - misplaced) % line;
  for (std::size_t d = 0; d < 3; ++d) {
    columns_.lo[d] = first + d * lanes;
    columns_.hi[d] = first + (3 + d) * lanes;
  }
  load(boxes, 0, boxes.size());
  cut(boxes.size());
}

template <class S>
void FewBoxes<S>::load(Span<const Box> boxes, std::size_t first, std::size_t end) noexcept {
  assert(end <= boxes.size() && boxes.size() <= lanes_);
  if constexpr (sizeof(S) == 4)
    HWY_DYNAMIC_DISPATCH(Load32)(boxes.data(), boxes.size(), first, end, columns_);
  else
    HWY_DYNAMIC_DISPATCH(Load64)(boxes.data(), boxes.size(), first, end, columns_);
}

template <class S>
std::size_t FewBoxes<S>::find_touching(const BoxKeys<S>& box, std::size_t size, std::uint64_t* bits) const {
  assert(size <= lanes_);
  if constexpr (sizeof(S) == 4)
    HWY_DYNAMIC_DISPATCH(Touching32)(columns_, box, size, bits);
  else
    HWY_DYNAMIC_DISPATCH(Touching64)(columns_, box, size, bits);
  return bit_words(size);
}

template <class S>
void FewBoxes<S>::find_row(std::uint32_t rank, std::size_t size, std::uint64_t* bits) const {
  assert(rank < size && size <= lanes_);
  if constexpr (sizeof(S) == 4)
    HWY_DYNAMIC_DISPATCH(Row32)(columns_, rank, size, bits);
  else
    HWY_DYNAMIC_DISPATCH(Row64)(columns_, rank, size, bits);
}

template <class S>
void FewBoxes<S>::find_rows(std::size_t size, std::uint64_t* rows) const {
  assert(size <= lanes_);
  if constexpr (sizeof(S) == 4)
    HWY_DYNAMIC_DISPATCH(Rows32)(columns_, size, rows);
  else
    HWY_DYNAMIC_DISPATCH(Rows64)(columns_, size, rows);
}

template <class S>
std::size_t FewBoxes<S>::find_hits(const RaySlabs<S>& ray, std::size_t size, S (&enter)[most_lanes],
                                   std::uint64_t* bits) const {
  assert(size <= lanes_ && !ray.is_long[0] && !ray.is_long[1] && !ray.is_long[2]);
  if constexpr (sizeof(S) == 4)
    HWY_DYNAMIC_DISPATCH(Hits32)(columns_, ray, size, enter, bits);
  else
    HWY_DYNAMIC_DISPATCH(Hits64)(columns_, ray, size, enter, bits);
  return bit_words(size);
}

template class FewBoxes<float>;
template class FewBoxes<double>;

}  // namespace boxstream::detail
#endif
