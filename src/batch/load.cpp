// SPDX-License-Identifier: MIT
//
// The front of every pass over boxes. Compiled once per SIMD target; the best one for the machine is picked at run
// time.

#include "batch/load.hpp"

#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/load.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "batch/columns_load-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Of a box that may have changed since its record was made: such boxes may have any pairs, but a record that ends
/// before it begins would have cells without number.
template <class S>
bool is_valid(const BasicAabb<S>& box, const Record& r) {
  return has_valid_keys(box) && r.lo[0] <= r.hi[0] && r.lo[1] <= r.hi[1] && r.lo[2] <= r.hi[2];
}

#if HWY_TARGET != HWY_SCALAR

/// Vectors of this many lanes make the eight words of a record: the keys of low and high ends, each with one lane more,
/// which id and `before` take.
template <class S>
constexpr std::size_t lanes_of =
    hn::MaxLanes(hn::CappedTag<std::conditional_t<sizeof(S) == 4, std::int32_t, std::int64_t>, 8>());
template <class S>
using Bits = hn::Simd<std::conditional_t<sizeof(S) == 4, std::int32_t, std::int64_t>, lanes_of<S>, 0>;
template <class S>
using Words = hn::Rebind<std::int32_t, Bits<S>>;

/// The bits of the coordinates that become words `word` and further; of one beyond the box, too.
template <class S>
HWY_INLINE hn::VFromD<Bits<S>> ends_of(const BasicAabb<S>& box, std::size_t word) {
  const Bits<S> d;
  const auto* bits = reinterpret_cast<const hn::TFromD<Bits<S>>*>(&box);
  if constexpr (lanes_of<S> == 8) {
    const hn::Half<decltype(d)> half;
    return hn::Combine(d, hn::LoadU(half, bits + 3), hn::LoadU(half, bits));
  } else {
    return hn::LoadU(d, bits + (word < 4 ? word : word - 1));
  }
}

/// The same as the map's operator.
HWY_INLINE hn::VFromD<Words<float>> to_keys(hn::VFromD<Bits<float>> bits, const KeyMap<float>&, std::size_t) {
  return keys_of(Words<float>(), bits);
}

HWY_INLINE hn::VFromD<Words<double>> to_keys(hn::VFromD<Bits<double>> bits, const KeyMap<double>& map,
                                             std::size_t word) {
  using Map = KeyMap<double>;
  const Bits<double> d;
  const hn::RebindToUnsigned<Bits<double>> du;
  const Words<double> d32;
  const hn::RebindToUnsigned<Words<double>> du32;
  const auto hidden_bit = hn::Set(d, Map::hidden_bit), one = hn::Set(d, std::int64_t{1});
  const auto sign = hn::BroadcastSignBit(bits), all_magnitude = hn::And(bits, hn::Set(d, INT64_MAX));
  const auto magnitude = hn::Min(all_magnitude, hn::Load(d, map.most() + word));
  const auto exponent = hn::Max(hn::ShiftRight<52>(magnitude), one);
  const auto below_top = hn::Min(hn::Sub(hn::Load(d, map.top() + word), exponent), hn::Set(d, std::int64_t{63}));
  const auto fraction = hn::Or(hn::And(magnitude, hn::Sub(hidden_bit, one)),
                               hn::IfThenZeroElse(hn::Lt(magnitude, hidden_bit), hidden_bit));
  const auto fixed = hn::Shr(hn::BitCast(du, hn::ShiftLeft<Map::headroom>(fraction)), hn::BitCast(du, below_top));
  const auto at = hn::Sub(hn::Xor(hn::BitCast(d, fixed), sign), sign), first = hn::Load(d, map.first() + word);
  const auto last = hn::Load(d, map.last() + word);
  const auto in_window = hn::Shr(hn::BitCast(du, hn::Sub(at, first)), hn::Load(du, map.shift() + word));
  const auto lowest = hn::Set(d32, -Map::outer / 2);
  const auto keys = hn::Add(hn::BitCast(d32, hn::TruncateTo(du32, in_window)), lowest);
  const auto below = hn::Gt(first, at), above = hn::Gt(at, last);
  if (HWY_LIKELY(hn::AllFalse(d, hn::Or(below, above)))) return keys;

  const auto order = keys_of(d, bits);
  const auto narrow = [&](auto v) { return hn::BitCast(d32, hn::TruncateTo(du32, hn::BitCast(du, v))); };
  const auto outer = hn::Set(d, std::int64_t{Map::outer});
  const auto offset = hn::IfThenElse(below, hn::Neg(outer), outer);
  const auto outer_keys = narrow(hn::Add(hn::ShiftRight<Map::outer_shift>(order), offset));
  const auto is_outer = narrow(hn::VecFromMask(d, hn::Or(below, above)));
  const auto leading = narrow(hn::ShiftRight<32>(order));
  return hn::IfVecThenElse(hn::Load(d32, map.leading() + word), leading, hn::IfVecThenElse(is_outer, outer_keys, keys));
}

/// Makes a record of a box behind which one coordinate more can be read. Makes `largest` that of all magnitudes.
template <class S>
HWY_INLINE void make_record(const BasicAabb<S>& box, std::uint32_t id, const KeyMap<S>& map,
                            hn::VFromD<Bits<S>>& largest, Record& out) {
  alignas(32) static constexpr std::int32_t is_key[8] = {-1, -1, -1, 0, -1, -1, -1, 0};
  alignas(32) static constexpr std::int32_t is_id[8] = {0, 0, 0, -1, 0, 0, 0, 0};
  const Bits<S> d;
  const Words<S> d32;
  const auto magnitude_bits = hn::Set(d, std::numeric_limits<hn::TFromD<Bits<S>>>::max());
  const auto ids = hn::Set(d32, static_cast<std::int32_t>(id));
  for (std::size_t word = 0; word < 8; word += lanes_of<S>) {
    const auto bits = ends_of(box, word);
    largest = hn::Max(largest, hn::And(bits, magnitude_bits));
    const auto keys = to_keys(bits, map, word);
    const auto words = hn::Or(hn::And(keys, hn::Load(d32, is_key + word)), hn::And(ids, hn::Load(d32, is_id + word)));
    hn::StoreU(words, d32, reinterpret_cast<std::int32_t*>(&out) + word);
  }
}

// In bytes. The open streams of a scatter leave the processor's own prefetching little room.
constexpr std::size_t prefetch_ahead = 2048;

template <class S>
HWY_INLINE std::uint64_t load_boxes(const BasicAabb<S>* HWY_RESTRICT boxes, std::size_t count, std::uint32_t first_id,
                                    const KeyMap<S>& map, Record* HWY_RESTRICT out) {
  static_assert(sizeof(BasicAabb<S>) == 6 * sizeof(S) && sizeof(Record) == 32);
  if (count == 0) return 0;
  const Bits<S> bits;
  auto largest = hn::Zero(bits);
  for (std::size_t i = 0; i + 1 < count; ++i) {
    if (i % (64 / sizeof(boxes[0])) == 0) hwy::Prefetch(reinterpret_cast<const char*>(boxes + i) + prefetch_ahead);
    make_record(boxes[i], first_id + static_cast<std::uint32_t>(i), map, largest, out[i]);
  }
  const BasicAabb<S> last[2] = {boxes[count - 1], BasicAabb<S>{}};  // nothing is read behind the caller's boxes
  make_record(last[0], first_id + static_cast<std::uint32_t>(count - 1), map, largest, out[count - 1]);
  const bool has_nan = hn::GetLane(hn::MaxOfLanes(bits, largest)) > infinity_key<S>;

  // Not zero in a lane in which the ends are not in order. Keys of doubles have to differ to be so for certain.
  const hn::FixedTag<std::int32_t, 4> d;
  const auto disorder = [&](const Record& r) {
    const auto lo = hn::LoadU(d, r.lo), hi = hn::LoadU(d, r.hi);
    return hn::Xor(hi, hn::Max(sizeof(S) == 4 ? lo : hn::Add(lo, hn::Set(d, 1)), hi));
  };
  const auto is_zero_but_for_fourth = [&](auto v) {
    return hn::AllTrue(d, hn::Or(hn::Eq(v, hn::Zero(d)), hn::Eq(hn::Iota(d, 0), hn::Set(d, 3))));
  };
  auto any_disorder = hn::Zero(d);
  for (std::size_t i = 0; i < count; ++i) any_disorder = hn::Or(any_disorder, disorder(out[i]));
  if (HWY_LIKELY(!has_nan && is_zero_but_for_fourth(any_disorder))) return ~std::uint64_t{0} >> (load_block - count);
  std::uint64_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_certain = !has_nan && is_zero_but_for_fourth(disorder(out[i]));
    valid |= std::uint64_t{is_certain || is_valid(boxes[i], out[i])} << i;
  }
  return valid;
}

#else

template <class S>
HWY_INLINE std::uint64_t load_boxes(const BasicAabb<S>* boxes, std::size_t count, std::uint32_t first_id,
                                    const KeyMap<S>& map, Record* out) {
  std::uint64_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    for (int d = 0; d < 3; ++d) {
      out[i].lo[d] = map(boxes[i].min[d], d);
      out[i].hi[d] = map(boxes[i].max[d], d);
    }
    out[i].id = first_id + static_cast<std::uint32_t>(i);
    out[i].before = 0;
    valid |= std::uint64_t{is_valid(boxes[i], out[i])} << i;
  }
  return valid;
}

#endif

HWY_ATTR std::uint64_t LoadRecords(const Aabb* boxes, std::size_t count, std::uint32_t first_id,
                                   const KeyMap<float>& keys, Record* out) {
  return load_boxes(boxes, count, first_id, keys, out);
}

HWY_ATTR std::uint64_t LoadRecords64(const Aabb64* boxes, std::size_t count, std::uint32_t first_id,
                                     const KeyMap<double>& keys, Record* out) {
  return load_boxes(boxes, count, first_id, keys, out);
}

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace boxstream::detail {

HWY_EXPORT(LoadRecords);
HWY_EXPORT(LoadRecords64);

std::uint64_t load_records(const Aabb* boxes, std::size_t count, std::uint32_t first_id, const KeyMap<float>& keys,
                           Record* out) {
  return HWY_DYNAMIC_DISPATCH(LoadRecords)(boxes, count, first_id, keys, out);
}

std::uint64_t load_records(const Aabb64* boxes, std::size_t count, std::uint32_t first_id, const KeyMap<double>& keys,
                           Record* out) {
  return HWY_DYNAMIC_DISPATCH(LoadRecords64)(boxes, count, first_id, keys, out);
}

}  // namespace boxstream::detail
#endif
