// SPDX-License-Identifier: MIT
//
// A set of few boxes compared all with all: by bytes first, and then by keys what may overlap; or by keys alone, where
// bytes do not part them. Bytes are a monotone map of keys, so that boxes whose bytes are apart are apart.

#if defined(BOXSTREAM_SMALL_BYTES_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_SMALL_BYTES_INL_HPP_
#undef BOXSTREAM_SMALL_BYTES_INL_HPP_
#else
#define BOXSTREAM_SMALL_BYTES_INL_HPP_
#endif

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "batch/records/columns.hpp"
#include "batch/records/columns_load-inl.hpp"
#include "batch/records/pair_buffer.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

constexpr std::size_t small_room = (thresholds.most_small + load_block - 1) / load_block * load_block;
template <class Key>
using SmallColumns = BoxColumnsOf<Key, small_room>;

// Boxes compared with one other at a time. The same on every target, for it shows in the order of pairs.
constexpr std::size_t byte_block = 32;

using ByteColumns = BoxColumnsOf<std::uint8_t, small_room>;

inline std::int32_t leading_bits(std::int32_t key) {
  return key;
}
inline std::int32_t leading_bits(std::int64_t key) {
  return static_cast<std::int32_t>(key >> 32);
}

#if HWY_TARGET != HWY_SCALAR

/// The 32 leading bits of keys.
template <class Key>
using Leading = hn::Rebind<std::int32_t, hn::CappedTag<Key, 8> >;

HWY_INLINE hn::VFromD<Leading<std::int32_t> > leading_of(const std::int32_t* keys) {
  return hn::Load(Leading<std::int32_t>(), keys);
}
HWY_INLINE hn::VFromD<Leading<std::int64_t> > leading_of(const std::int64_t* keys) {
  const hn::CappedTag<std::int64_t, 8> d64;
  const hn::RebindToUnsigned<decltype(d64)> du64;
  const hn::RebindToUnsigned<Leading<std::int64_t> > du;
  const auto upper = hn::ShiftRight<32>(hn::BitCast(du64, hn::Load(d64, keys)));
  return hn::BitCast(Leading<std::int64_t>(), hn::TruncateTo(du, upper));
}

/// Each lane of 32 bits by as many as its own lane says, at most 31.
template <class V>
HWY_INLINE V shifted_right(V values, V places) {
#if HWY_ARCH_X86 && HWY_TARGET > HWY_AVX2
  // Processors without such an instruction: Highway would make powers of two by converting floats, which for 2^31 is an
  // invalid operation.
  const hn::DFromV<V> d;
  const hn::RepartitionToWide<hn::DFromV<V> > wide;
  const auto lower = hn::Set(wide, 0xffffffffu);
  const auto even = hn::Shr(hn::And(hn::BitCast(wide, values), lower), hn::And(hn::BitCast(wide, places), lower));
  const auto odd =
      hn::Shr(hn::ShiftRight<32>(hn::BitCast(wide, values)), hn::ShiftRight<32>(hn::BitCast(wide, places)));
  return hn::BitCast(d, hn::Or(even, hn::ShiftLeft<32>(odd)));
#else
  return hn::Shr(values, places);
#endif
}

#endif

/// Leading bits of keys to bytes, spaced about evenly in the caller's coordinates between the least high and the
/// largest low end of an axis. Low ends before it and high ends behind it meet all, so that large boxes take no bits
/// from others. In integers, for the caller's floating-point environment may be any.
template <class Key>
class ByteMap {
 public:
  ByteMap(std::int32_t least_high, std::int32_t largest_low)
      : first_(std::min(least_high, largest_low)), last_(largest_low) {
    top_ = std::max(magnitude(first_), magnitude(last_)) >> mantissa_bits;
    origin_ = fixed_point(first_);
    shift_ = std::max(0, static_cast<int>(std::bit_width(fixed_point(last_) - origin_)) - 8);
  }

#if HWY_TARGET != HWY_SCALAR
  HWY_INLINE auto operator()(hn::VFromD<Leading<Key> > key) const {
    const Leading<Key> d;
    const hn::RebindToUnsigned<Leading<Key> > du;
    key = hn::Min(hn::Max(key, hn::Set(d, first_)), hn::Set(d, last_));
    const auto sign = hn::BroadcastSignBit(key), size = hn::Xor(key, sign);
    const auto below_top = hn::Min(hn::Sub(hn::Set(d, top_), hn::ShiftRight<mantissa_bits>(size)), hn::Set(d, 31));
    const auto fraction = hn::ShiftLeft<headroom>(hn::Or(hn::And(size, hn::Set(d, hidden - 1)), hn::Set(d, hidden)));
    const auto fixed = hn::BitCast(d, shifted_right(hn::BitCast(du, fraction), hn::BitCast(du, below_top)));
    const auto at = hn::Sub(hn::Sub(hn::Xor(fixed, sign), sign), hn::Set(d, static_cast<std::int32_t>(origin_)));
    const auto byte = hn::ShiftRightSame(hn::BitCast(du, at), shift_);
    return hn::TruncateTo(hn::Rebind<std::uint8_t, Leading<Key> >(), byte);
  }
#else
  std::uint8_t operator()(std::int32_t key) const {
    const std::int32_t clamped = std::min(std::max(key, first_), last_);
    return static_cast<std::uint8_t>((fixed_point(clamped) - origin_) >> shift_);
  }
#endif

 private:
  static constexpr int mantissa_bits = sizeof(Key) == 4 ? 23 : 20;
  static constexpr int headroom = 30 - mantissa_bits;
  static constexpr std::int32_t hidden = std::int32_t{1} << mantissa_bits;

  static std::int32_t magnitude(std::int32_t key) {
    return key ^ (key >> 31);
  }
  /// In units of a fraction of the last place of the largest, as the operator has it; two's complement.
  std::uint32_t fixed_point(std::int32_t key) const {
    const std::int32_t size = magnitude(key);
    const auto fraction = static_cast<std::uint32_t>((size & (hidden - 1)) | hidden) << headroom;
    const std::uint32_t fixed = fraction >> std::min(top_ - (size >> mantissa_bits), 31);
    const auto sign = static_cast<std::uint32_t>(key >> 31);
    return (fixed ^ sign) - sign;
  }

  std::int32_t first_, last_, top_;
  std::uint32_t origin_;
  int shift_;
};

#if HWY_TARGET != HWY_SCALAR

/// Of the valid ones among `size` boxes. Lanes up to the next block may hold anything.
template <class Key>
HWY_INLINE ByteMap<Key> make_byte_map(const SmallColumns<Key>& columns, std::size_t size, int axis) {
  const Leading<Key> d;
  const auto most = hn::Set(d, INT32_MAX), least = hn::Set(d, INT32_MIN);
  auto least_high = most, largest_low = least;
  for (std::size_t at = 0; at < size; at += hn::MaxLanes(d)) {
    const auto invalid = hn::Gt(leading_of(columns.lo[0] + at), leading_of(columns.hi[0] + at));
    least_high = hn::Min(least_high, hn::IfThenElse(invalid, most, leading_of(columns.hi[axis] + at)));
    largest_low = hn::Max(largest_low, hn::IfThenElse(invalid, least, leading_of(columns.lo[axis] + at)));
  }
  return {hn::GetLane(hn::MinOfLanes(d, least_high)), hn::GetLane(hn::MaxOfLanes(d, largest_low))};
}

/// Lanes up to the next whole block are set.
template <class Key>
HWY_INLINE void make_bytes(const SmallColumns<Key>& columns, std::size_t size, ByteColumns& out) {
  const hn::Rebind<std::uint8_t, Leading<Key> > d8;
  for (int axis = 0; axis < 3; ++axis) {
    const ByteMap<Key> map = make_byte_map(columns, size, axis);
    std::size_t at = 0;
    for (; at < size; at += hn::MaxLanes(d8)) {
      hn::Store(map(leading_of(columns.lo[axis] + at)), d8, out.lo[axis] + at);
      hn::Store(map(leading_of(columns.hi[axis] + at)), d8, out.hi[axis] + at);
    }
    for (; at % byte_block != 0; at += hn::MaxLanes(d8)) {
      hn::Store(hn::Zero(d8), d8, out.lo[axis] + at);
      hn::Store(hn::Zero(d8), d8, out.hi[axis] + at);
    }
  }
}

/// Of the block at `at`, a bit for each box that may overlap box `other`.
HWY_INLINE std::uint32_t find_near(const ByteColumns& boxes, std::size_t at, std::size_t other) {
  const hn::CappedTag<std::uint8_t, byte_block> d;
  std::uint32_t near = 0;
  for (std::size_t k = 0; k < byte_block; k += hn::MaxLanes(d)) {
    auto apart = hn::Zero(d);
    for (int axis = 0; axis < 3; ++axis) {
      const auto lo = hn::Load(d, boxes.lo[axis] + at + k), hi = hn::Load(d, boxes.hi[axis] + at + k);
      apart = hn::Or(apart, hn::SaturatedSub(hn::Set(d, boxes.lo[axis][other]), hi));
      apart = hn::Or(apart, hn::SaturatedSub(lo, hn::Set(d, boxes.hi[axis][other])));
    }
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, hn::Eq(apart, hn::Zero(d)), bits);
    for (std::size_t i = 0; i < hn::MaxLanes(d) / 8; ++i) near |= std::uint32_t{bits[i]} << (k + 8 * i);
  }
  return near;
}

#else

template <class Key>
void make_bytes(const SmallColumns<Key>& columns, std::size_t size, ByteColumns& out) {
  for (int axis = 0; axis < 3; ++axis) {
    std::int32_t least_high = INT32_MAX, largest_low = INT32_MIN;
    for (std::size_t i = 0; i < size; ++i) {
      if (leading_bits(columns.lo[0][i]) > leading_bits(columns.hi[0][i])) continue;
      least_high = std::min(least_high, leading_bits(columns.hi[axis][i]));
      largest_low = std::max(largest_low, leading_bits(columns.lo[axis][i]));
    }
    const ByteMap<Key> map(least_high, largest_low);
    for (std::size_t i = 0; i < (size + byte_block - 1) / byte_block * byte_block; ++i) {
      out.lo[axis][i] = i < size ? map(leading_bits(columns.lo[axis][i])) : 0;
      out.hi[axis][i] = i < size ? map(leading_bits(columns.hi[axis][i])) : 0;
    }
  }
}

inline std::uint32_t find_near(const ByteColumns& boxes, std::size_t at, std::size_t other) {
  std::uint32_t near = 0;
  for (std::size_t k = 0; k < byte_block; ++k) {
    bool apart = false;
    for (int axis = 0; axis < 3; ++axis)
      apart = apart || boxes.lo[axis][other] > boxes.hi[axis][at + k] || boxes.lo[axis][at + k] > boxes.hi[axis][other];
    near |= std::uint32_t{!apart} << k;
  }
  return near;
}

#endif

/// Of the block at `at`, a bit for each box that overlaps box `other`, by keys.
template <class Key>
HWY_INLINE std::uint32_t find_overlapping(const SmallColumns<Key>& columns, std::size_t at, std::size_t other) {
  const Narrow<Key> d;
  Bounds<Narrow<Key> > one, many;
  one.repeat(columns, other);
  std::uint32_t apart = 0;
  for (std::size_t k = 0; k < byte_block; k += hn::MaxLanes(d)) {
    many.load(columns, at + k);
    apart |= bits_of(d, one.disjoint(many)) << k;
  }
  return ~apart;
}

/// The same of two boxes.
template <class Key>
HWY_INLINE bool overlap(const SmallColumns<Key>& columns, std::size_t i, std::size_t j) {
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis)
    apart |= (columns.lo[axis][i] > columns.hi[axis][j]) | (columns.lo[axis][j] > columns.hi[axis][i]);
  return !apart;
}

/// Boxes of a block that may overlap another box, a bit each.
struct Near {
  std::uint32_t other, boxes;
};

/// Written always, and kept by advancing or not.
HWY_INLINE Near* note(Near* end, std::size_t other, std::uint32_t boxes) {
  *end = {static_cast<std::uint32_t>(other), boxes};
  return end + (boxes != 0 ? 1 : 0);
}

/// Bytes say which boxes may overlap, and keys which of these do.
template <class Key>
struct ByBytes {
  const SmallColumns<Key>& columns;
  const ByteColumns& bytes;

  HWY_INLINE std::uint32_t find(std::size_t at, std::size_t other) const { return find_near(bytes, at, other); }
  HWY_INLINE bool confirm(std::size_t box, std::size_t other) const { return overlap(columns, box, other); }
};

/// Keys alone.
template <class Key>
struct ByKeys {
  const SmallColumns<Key>& columns;

  HWY_INLINE std::uint32_t find(std::size_t at, std::size_t other) const {
    return find_overlapping(columns, at, other);
  }
  HWY_INLINE bool confirm(std::size_t, std::size_t) const { return true; }
};

/// Emits those that overlap of the block at `at`.
template <class Look>
HWY_INLINE bool emit_near(const Look& look, const Near* each, const Near* end, std::size_t at, std::uint32_t first_id,
                          PairBuffer& pairs) {
  for (; each != end; ++each) {
    Pair* out = pairs.end();
    for (std::uint32_t left = each->boxes; left != 0; left &= left - 1) {
      const auto box = static_cast<std::uint32_t>(at) + static_cast<std::uint32_t>(std::countr_zero(left));
      *out = {first_id + box, first_id + each->other};
      out += look.confirm(box, each->other) ? 1 : 0;
    }
    pairs.set_end(out);
    if (HWY_UNLIKELY(out >= pairs.limit()) && !pairs.flush()) return false;
  }
  return true;
}

/// Emits the pairs of the boxes of two blocks at `at` with all behind each. Both are compared with a box before the
/// next, which is read once then, and the pairs of the one come before those of the other.
template <class Look>
HWY_INLINE bool compare_two_blocks(const Look& look, std::size_t at, std::size_t size, std::uint32_t first_id,
                                   PairBuffer& pairs) {
  const std::size_t second = std::min(at + byte_block, size), behind = std::min(second + byte_block, size);
  Near of_first[small_room], of_second[small_room], *end_first = of_first, *end_second = of_second;
  const auto below = [](std::size_t boxes) { return (std::uint32_t{1} << boxes) - 1; };
  for (std::size_t other = at; other < second; ++other)
    end_first = note(end_first, other, look.find(at, other) & below(other - at));
  for (std::size_t other = second; other < behind; ++other) {
    end_first = note(end_first, other, look.find(at, other));
    end_second = note(end_second, other, look.find(second, other) & below(other - second));
  }
  for (std::size_t other = behind; other < size; ++other) {
    const std::uint32_t near_first = look.find(at, other), near_second = look.find(second, other);
    end_first = note(end_first, other, near_first);
    end_second = note(end_second, other, near_second);
  }
  return emit_near(look, of_first, end_first, at, first_id, pairs) &&
         emit_near(look, of_second, end_second, second, first_id, pairs);
}

template <class Look>
HWY_INLINE void compare_blocks(const Look& look, std::size_t size, std::uint32_t first_id, PairBuffer& pairs) {
  for (std::size_t at = 0; at < size; at += 2 * byte_block)
    if (!compare_two_blocks(look, at, size, first_id, pairs)) return;
}

/// Whether few boxes seem to overlap and do not: one of a block and another box, on average of a part of them, and some
/// more. With more of them keys alone take less time. Crowds that are small beside the whole share a byte.
template <class Key>
HWY_INLINE bool are_parted(const SmallColumns<Key>& columns, const ByteColumns& bytes, std::size_t size) {
  const std::size_t blocks = size / byte_block, tried = blocks == 0 ? 0 : size / thresholds.others_of_try,
                    most_seeming = tried + thresholds.seeming_by_chance;
  std::size_t near = 0, overlapping = 0;
  for (std::size_t i = 0; i < tried; ++i)
    near += static_cast<std::size_t>(
        std::popcount(find_near(bytes, 7 * i % blocks * byte_block, thresholds.others_of_try * i)));
  if (near <= most_seeming) return true;
  for (std::size_t i = 0; i < tried; ++i)
    overlapping += static_cast<std::size_t>(
        std::popcount(find_overlapping(columns, 7 * i % blocks * byte_block, thresholds.others_of_try * i)));
  return near - overlapping <= most_seeming;
}

/// Boxes up to the next whole block may be anything.
template <class Key>
HWY_INLINE void compare_by_bytes(const SmallColumns<Key>& columns, std::size_t size, std::uint32_t first_id,
                                 PairBuffer& pairs) {
  ByteColumns bytes;
  make_bytes(columns, size, bytes);
  if (are_parted(columns, bytes, size))
    compare_blocks(ByBytes<Key>{columns, bytes}, size, first_id, pairs);
  else
    compare_blocks(ByKeys<Key>{columns}, size, first_id, pairs);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
