// SPDX-License-Identifier: MIT
//
// The close look at a block of boxes and one other, all bounds at full precision, and the pairs that come of it.

#if defined(BOXSTREAM_SWEEP_EMIT_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_SWEEP_EMIT_INL_HPP_
#undef BOXSTREAM_SWEEP_EMIT_INL_HPP_
#else
#define BOXSTREAM_SWEEP_EMIT_INL_HPP_
#endif

#include <bit>
#include <cstddef>
#include <cstdint>

#include "base/arena.hpp"
#include "batch/records/quadruples-inl.hpp"
#include "batch/records/record.hpp"
#include "batch/records/sweep_lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

/// Records as a structure of arrays.
struct Columns {
  const std::int32_t* lo[3] = {};
  const std::int32_t* hi[3] = {};
  const std::uint32_t* id = nullptr;
  const std::uint32_t* before = nullptr;
};

/// Of `room` records.
inline HWY_ATTR Columns make_columns(const Record* records, std::size_t room, Arena& arena) {
  std::int32_t* column[8];
  const std::size_t stride = (room + block - 1) / block * block;  // so that each is aligned as the first
  column[0] = arena.allocate<std::int32_t>(8 * stride);
  for (std::size_t c = 1; c < 8; ++c) column[c] = column[c - 1] + stride;
  for (std::size_t i = 0; i < room; i += lanes) {
    V words[4];
    for (int half = 0; half < 8; half += 4) {
      load_columns_of(D(), records + i, room - 1 - i, half, words);
      for (int c = 0; c < 4; ++c) hn::StoreU(words[c], D(), column[half + c] + i);
    }
  }
  Columns columns;
  for (int d = 0; d < 3; ++d) {
    columns.lo[d] = column[d];
    columns.hi[d] = column[4 + d];
  }
  columns.id = reinterpret_cast<const std::uint32_t*>(column[3]);
  columns.before = reinterpret_cast<const std::uint32_t*>(column[7]);
  return columns;
}

enum class Emit { sorted, set_first, other_first };
enum class Ties { kept, dropped };  // pairs whose low ends on the sweep axis are equal

/// Stores those of the lanes in `bits`, of the boxes at `at`, that are pairs with `one`; returns where they end.
template <Emit emit, bool one_is_of_set>
HWY_INLINE Pair* put(const Record& one, const Columns& many, std::size_t at, std::uint32_t bits, Pair* out) {
  const D d;
  const DU du;
  const auto disjoint = [&](int axis) {
    return hn::Or(hn::Gt(hn::LoadU(d, many.lo[axis] + at), hn::Set(d, one.hi[axis])),
                  hn::Gt(hn::Set(d, one.lo[axis]), hn::LoadU(d, many.hi[axis] + at)));
  };
  const auto owned = hn::Eq(hn::And(hn::LoadU(du, many.before + at), hn::Set(du, one.before)), hn::Zero(du));
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8)};
  const auto hit =
      hn::And(hn::LoadMaskBits(du, bytes),
              hn::AndNot(hn::RebindMask(du, hn::Or(hn::Or(disjoint(0), disjoint(1)), disjoint(2))), owned));
  const std::size_t count = hn::CountTrue(du, hit);
  const auto id = hn::Set(du, one.id), found = compressed(du, hn::LoadU(du, many.id + at), hit);
  if constexpr (emit == Emit::sorted)
    store(hn::Min(id, found), hn::Max(id, found), count, out);
  else if constexpr ((emit == Emit::set_first) == one_is_of_set)
    store(id, found, count, out);
  else
    store(found, id, count, out);
  return out + count;
}

/// Whether two boxes overlap on all axes and this region owns the pair.
HWY_INLINE bool is_pair(const Record& x, const Record& y) {
#if HWY_TARGET == HWY_SCALAR
  const bool disjoint = x.lo[0] > y.hi[0] || y.lo[0] > x.hi[0] || x.lo[1] > y.hi[1] || y.lo[1] > x.hi[1] ||
                        x.lo[2] > y.hi[2] || y.lo[2] > x.hi[2];
  return !disjoint && (x.before & y.before) == 0;
#else
  const hn::FixedTag<std::int32_t, 4> d;
  const auto disjoint =
      hn::Or(hn::Gt(hn::Load(d, x.lo), hn::Load(d, y.hi)), hn::Gt(hn::Load(d, y.lo), hn::Load(d, x.hi)));
  std::uint8_t bits[8];
  hn::StoreMaskBits(d, disjoint, bits);
  return ((bits[0] & 7u) | (x.before & y.before)) == 0;
#endif
}

/// Whether an end of `one` has the key of an opposite end of any box of the block at `at`, on one of the `axes`.
HWY_INLINE bool shares_key(const Record& one, const Columns& many, std::size_t at, std::uint32_t axes) {
  const D d;
  auto shares = hn::MaskFromVec(hn::Zero(d));
  for (; axes != 0; axes &= axes - 1) {
    const int axis = std::countr_zero(axes);
    for (std::size_t i = at; i < at + block; i += lanes) {
      shares = hn::Or(shares, hn::Eq(hn::LoadU(d, many.lo[axis] + i), hn::Set(d, one.hi[axis])));
      shares = hn::Or(shares, hn::Eq(hn::LoadU(d, many.hi[axis] + i), hn::Set(d, one.lo[axis])));
    }
  }
  return !hn::AllFalse(d, shares);
}

/// The same of two boxes.
HWY_INLINE bool shares_key(const Record& x, const Record& y, std::uint32_t axes) {
#if HWY_TARGET == HWY_SCALAR
  bool shares = false;
  for (int d = 0; d < 3; ++d) shares |= (axes >> d & 1) != 0 && (x.lo[d] == y.hi[d] || y.lo[d] == x.hi[d]);
  return shares;
#else
  const hn::FixedTag<std::int32_t, 4> d;
  const auto same = hn::Or(hn::Eq(hn::Load(d, x.lo), hn::Load(d, y.hi)), hn::Eq(hn::Load(d, y.lo), hn::Load(d, x.hi)));
  std::uint8_t bits[8];
  hn::StoreMaskBits(d, same, bits);
  return (bits[0] & axes) != 0;
#endif
}

/// Axes on which any two of some boxes share a key.
class SharedKeys {
 public:
#if HWY_TARGET == HWY_SCALAR
  void add(const Record& x, const Record& y) {
    for (int d = 0; d < 3; ++d) axes_ |= (x.lo[d] == y.hi[d] || y.lo[d] == x.hi[d] ? 1u : 0u) << d;
  }
  bool on(std::uint32_t axes) const {
    return (axes_ & axes) != 0;
  }

 private:
  std::uint32_t axes_ = 0;
#else
  HWY_INLINE SharedKeys() {
    least_difference_ = hn::Set(DW(), UINT32_MAX);
  }
  HWY_INLINE void add(const Record& x, const Record& y) {
    least_difference_ = hn::Min(least_difference_, hn::Min(difference(x, y), difference(y, x)));
  }
  HWY_INLINE bool on(std::uint32_t axes) const {
    return (bits_of(DW(), hn::Eq(least_difference_, hn::Zero(DW()))) & axes) != 0;
  }

 private:
  using DW = hn::FixedTag<std::uint32_t, 4>;
  static HWY_INLINE hn::VFromD<DW> difference(const Record& x, const Record& y) {
    const hn::FixedTag<std::int32_t, 4> d;
    return hn::BitCast(DW(), hn::Xor(hn::Load(d, x.lo), hn::Load(d, y.hi)));
  }

  hn::VFromD<DW> least_difference_;
#endif
};

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
