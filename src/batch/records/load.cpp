// SPDX-License-Identifier: MIT
//
// The front of every pass over boxes. Compiled once per SIMD target; the best one for the machine is picked at run
// time.

#include "batch/records/load.hpp"

#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/records/load.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>  // compiles this file again for each target
#include <hwy/highway.h>

#include "batch/records/columns_load-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// By how much keys of low ends may be above those of high ends.
inline std::int32_t most_above(const KeyMap<float>& map) {
  return off_high(map.faces());
}
inline std::int32_t most_above(const KeyMap<double>&) {
  return 0;
}

/// Of a box that may have changed since its record was made: such boxes may have any pairs, but not a record that ends
/// long before it begins.
template <class S>
bool is_valid(const BasicAabb<S>& box, const Record& r, std::int32_t off) {
  if (!has_valid_keys(box)) return false;
  for (int d = 0; d < 3; ++d)
    if (r.lo[d] > std::int64_t{r.hi[d]} + off) return false;
  return true;
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

/// What is made of coordinates: the keys of those in windows; and which bits they lose; and the keys of all others.
enum class Pass { keys, losses, outliers };

/// What the keys of a block leave out.
template <class S>
struct Losses {
  static constexpr std::size_t size = lanes_of<S> < 4 ? 4 / lanes_of<S> : 1;

  hn::VFromD<Bits<S>> largest;     // of all magnitudes
  hn::VFromD<Bits<S>> outside;     // a sign if any coordinate is outside of its window
  hn::VFromD<Bits<S>> lost[size];  // bits, by axis in each four lanes

  // One that the compiler makes would be outside the SIMD target.
  HWY_INLINE Losses() {
    const auto none = hn::Zero(Bits<S>());
    largest = outside = none;
    for (auto& l : lost) l = none;
  }
  HWY_INLINE void add(hn::VFromD<Bits<S>> more, std::size_t word) {
    auto& l = lost[word / lanes_of<S> % size];
    l = hn::Or(l, more);
  }
  HWY_INLINE bool has_outliers() const {
    const Bits<S> d;
    return !hn::AllFalse(d, hn::Lt(outside, hn::Zero(d)));
  }
  HWY_INLINE bool has_nan() const { return hn::GetLane(hn::MaxOfLanes(Bits<S>(), largest)) > infinity_key<S>; }
  /// A bit each. The other contents of the fourth lanes do not matter.
  HWY_INLINE std::uint32_t axes() const {
    const Bits<S> d;
    std::uint32_t words = 0;
    for (std::size_t v = 0; v < size; ++v) words |= bits_of(d, hn::Ne(lost[v], hn::Zero(d))) << (v * lanes_of<S>);
    return (words | words >> 4) & 7;
  }
};

/// The same as the map's operator.
template <Pass pass>
HWY_INLINE hn::VFromD<Words<double>> to_keys(hn::VFromD<Bits<double>> bits, const KeyMap<double>& map, std::size_t word,
                                             Losses<double>& losses) {
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
  const auto scaled = hn::BitCast(du, hn::ShiftLeft<Map::headroom>(fraction));
  const auto fixed = hn::Shr(scaled, hn::BitCast(du, below_top));
  const auto at = hn::Sub(hn::Xor(hn::BitCast(d, fixed), sign), sign), first = hn::Load(d, map.first() + word);
  const auto last = hn::Load(d, map.last() + word);
  const auto from_first = hn::BitCast(du, hn::Sub(at, first)), shift = hn::Load(du, map.shift() + word);
  const auto in_window = hn::Shr(from_first, shift);
  const auto lowest = hn::Set(d32, -Map::outer / 2);
  const auto keys = hn::Add(hn::BitCast(d32, hn::TruncateTo(du32, in_window)), lowest);
  auto lost = hn::Zero(d);
  if constexpr (pass != Pass::keys)
    lost = hn::BitCast(d, hn::Or(hn::Xor(scaled, hn::Shl(fixed, hn::BitCast(du, below_top))),
                                 hn::Xor(from_first, hn::Shl(in_window, shift))));
  if constexpr (pass != Pass::outliers) {
    losses.outside = hn::Or(losses.outside, hn::Or(hn::BitCast(d, from_first), hn::Sub(last, at)));
    if constexpr (pass == Pass::losses) losses.add(lost, word);
    return keys;
  }

  const auto below = hn::Gt(first, at), above = hn::Gt(at, last), outside = hn::Or(below, above);
  const auto order = keys_of(d, bits);
  const auto narrow = [&](auto v) { return hn::BitCast(d32, hn::TruncateTo(du32, hn::BitCast(du, v))); };
  const auto outer = hn::Set(d, std::int64_t{Map::outer});
  const auto offset = hn::IfThenElse(below, hn::Neg(outer), outer);
  const auto outer_keys = narrow(hn::Add(hn::ShiftRight<Map::outer_shift>(order), offset));
  const auto is_outer = narrow(hn::VecFromMask(d, outside));
  const auto leading = narrow(hn::ShiftRight<32>(order)), has_leading = hn::Load(d32, map.leading() + word);
  const auto lost_in_leading = hn::And(bits, hn::Set(d, std::int64_t{UINT32_MAX}));
  losses.add(
      hn::IfVecThenElse(hn::PromoteTo(d, has_leading), lost_in_leading, hn::Or(lost, hn::VecFromMask(d, outside))),
      word);
  return hn::IfVecThenElse(has_leading, leading, hn::IfVecThenElse(is_outer, outer_keys, keys));
}

// Of the words of a record.
alignas(32) constexpr std::int32_t is_key[8] = {-1, -1, -1, 0, -1, -1, -1, 0};
alignas(32) constexpr std::int32_t is_id[8] = {0, 0, 0, -1, 0, 0, 0, 0};

HWY_INLINE bool is_zero_but_for_fourth(hn::VFromD<hn::FixedTag<std::int32_t, 4>> v) {
  const hn::FixedTag<std::int32_t, 4> d;
  return hn::AllTrue(d, hn::Or(hn::Eq(v, hn::Zero(d)), hn::Eq(hn::Iota(d, 0), hn::Set(d, 3))));
}

/// Makes records of boxes in a row behind which one coordinate more can be read.
template <Pass pass>
class MakeRecords64 {
 public:
  HWY_INLINE MakeRecords64(std::uint32_t first_id, const KeyMap<double>& map) : map_(map), id_(first_id) {}

  HWY_INLINE void make(const Aabb64& box, Record& out) {
    const Bits<double> d;
    const Words<double> d32;
    const auto magnitude_bits = hn::Set(d, INT64_MAX);
    const auto ids = hn::Set(d32, static_cast<std::int32_t>(id_));
    for (std::size_t word = 0; word < 8; word += lanes_of<double>) {
      const auto bits = ends_of(box, word);
      losses.largest = hn::Max(losses.largest, hn::And(bits, magnitude_bits));
      const auto keys = to_keys<pass>(bits, map_, word, losses);
      const auto words = hn::Or(hn::And(keys, hn::Load(d32, is_key + word)), hn::And(ids, hn::Load(d32, is_id + word)));
      hn::StoreU(words, d32, reinterpret_cast<std::int32_t*>(&out) + word);
    }
    ++id_;
  }

  Losses<double> losses;

 private:
  const KeyMap<double>& map_;
  std::uint32_t id_;
};

/// The same of floats; and whether all boxes end where they begin or later.
template <std::size_t words_at_once = lanes_of<float>>
class MakeRecords {
 public:
  HWY_INLINE MakeRecords(std::uint32_t first_id, const KeyMap<float>& map) {
    const auto off = hn::Set(d_, off_high(map.faces()));
    off_ = whole ? hn::ConcatUpperLower(d_, off, hn::Zero(d_)) : off;
    const auto is_id_word = hn::Load(d_, is_id);
    next_ = hn::And(is_id_word, hn::Set(d_, 1));
    ids_ = hn::And(is_id_word, hn::Set(d_, static_cast<std::int32_t>(first_id)));
    largest_ = hn::Zero(d_);
    disorder_ = hn::Zero(half_);
  }

  HWY_INLINE void make(const Aabb& box, Record& out) {
    auto* const words = reinterpret_cast<std::int32_t*>(&out);
    const auto keys_only = hn::Load(d_, is_key);
    if constexpr (whole) {
      const auto keys = to_keys(ends_of(box, 0));
      check_order(hn::LowerHalf(half_, keys), hn::UpperHalf(half_, keys));
      hn::StoreU(hn::Or(hn::And(hn::Sub(keys, off_), keys_only), ids_), d_, words);
    } else {
      const auto lo = to_keys(ends_of(box, 0)), hi = to_keys(ends_of(box, 4));
      check_order(lo, hi);
      hn::StoreU(hn::Or(hn::And(lo, keys_only), ids_), d_, words);
      hn::StoreU(hn::And(hn::Sub(hi, off_), keys_only), d_, words + 4);
    }
    ids_ = hn::Add(ids_, next_);
  }

  HWY_INLINE bool has_nan() const { return hn::GetLane(hn::MaxOfLanes(d_, largest_)) > infinity_key<float>; }
  HWY_INLINE bool is_in_order() const { return is_zero_but_for_fourth(disorder_); }

 private:
  static constexpr bool whole = words_at_once == 8;  // in one vector
  using Half = hn::FixedTag<std::int32_t, 4>;

  HWY_INLINE hn::VFromD<Words<float>> to_keys(hn::VFromD<Words<float>> bits) {
    largest_ = hn::Max(largest_, hn::And(bits, hn::Set(d_, INT32_MAX)));
    return keys_of(d_, bits);
  }
  HWY_INLINE void check_order(hn::VFromD<Half> lo, hn::VFromD<Half> hi) {
    disorder_ = hn::Or(disorder_, hn::Xor(hi, hn::Max(lo, hi)));
  }

  static constexpr Words<float> d_{};
  static constexpr Half half_{};
  hn::VFromD<Words<float>> off_, next_, ids_, largest_;
  hn::VFromD<Half> disorder_;
};

/// Whether min <= max on all axes, for a box without NaN; without a branch.
HWY_INLINE bool is_in_order(const Aabb64& box) {
  bool disorder = false;
  for (int d = 0; d < 3; ++d) disorder |= order_key(box.min[d]) > order_key(box.max[d]);
  return !disorder;
}

// In bytes. The open streams of a scatter leave the processor's own prefetching little room.
constexpr std::size_t prefetch_ahead = 2048;

template <class S, class Make>
HWY_INLINE void make_records(const BasicAabb<S>* HWY_RESTRICT boxes, std::size_t count, Make& make,
                             Record* HWY_RESTRICT out) {
  constexpr std::size_t in_line = 64 / sizeof(boxes[0]);
  std::size_t i = 0;
  for (; i + in_line < count; i += in_line) {
    hwy::Prefetch(reinterpret_cast<const char*>(boxes + i) + prefetch_ahead);
    for (std::size_t k = i; k < i + in_line; ++k) make.make(boxes[k], out[k]);
  }
  for (; i + 1 < count; ++i) make.make(boxes[i], out[i]);
  const BasicAabb<S> last[2] = {boxes[count - 1], boxes[count - 1]};  // nothing is read behind the caller's boxes
  make.make(last[0], out[count - 1]);
}

/// What records do not tell of the boxes that they were made of.
struct Made {
  bool has_nan;
  bool is_in_order;     // all for certain
  std::uint32_t lossy;  // axes on which bits are lost; all of the map's if that is known before
};

HWY_INLINE Made make_all_records(const Aabb* HWY_RESTRICT boxes, std::size_t count, std::uint32_t first_id,
                                 const KeyMap<float>& map, Record* HWY_RESTRICT out) {
  MakeRecords<> make(first_id, map);
  make_records(boxes, count, make, out);
  return {make.has_nan(), make.is_in_order(), 0};
}

template <Pass pass>
HWY_INLINE Losses<double> make_records(const Aabb64* HWY_RESTRICT boxes, std::size_t count, std::uint32_t first_id,
                                       const KeyMap<double>& map, Record* HWY_RESTRICT out) {
  MakeRecords64<pass> make(first_id, map);
  make_records(boxes, count, make, out);
  return make.losses;
}

HWY_INLINE Made make_all_records(const Aabb64* HWY_RESTRICT boxes, std::size_t count, std::uint32_t first_id,
                                 const KeyMap<double>& map, Record* HWY_RESTRICT out) {
  const bool all_lose = map.lossy().all() == LossyAxes::every;
  Losses<double> losses;
  if (!map.has_leading())
    losses = all_lose ? make_records<Pass::keys>(boxes, count, first_id, map, out)
                      : make_records<Pass::losses>(boxes, count, first_id, map, out);
  if (HWY_UNLIKELY(map.has_leading() || losses.has_outliers()))
    losses = make_records<Pass::outliers>(boxes, count, first_id, map, out);
  if (all_lose) return {losses.has_nan(), false, LossyAxes::every};
  map.lossy().add(losses.axes());
  return {losses.has_nan(), false, losses.axes()};
}

template <class S>
HWY_INLINE std::uint64_t load_boxes(const BasicAabb<S>* HWY_RESTRICT boxes, std::size_t count, std::uint32_t first_id,
                                    const KeyMap<S>& map, Record* HWY_RESTRICT out) {
  static_assert(sizeof(BasicAabb<S>) == 6 * sizeof(S) && sizeof(Record) == 32);
  if (count == 0) return 0;
  const auto [has_nan, is_in_order_for_certain, lossy] = make_all_records(boxes, count, first_id, map, out);
  const std::uint64_t all = ~std::uint64_t{0} >> (load_block - count);
  if (HWY_LIKELY(is_in_order_for_certain && !has_nan)) return all;

  // Not zero in a lane in which the ends are not in order. Keys that lost bits have to differ to be so for certain.
  const hn::FixedTag<std::int32_t, 4> d;
  alignas(16) const std::int32_t least_sides[4] = {static_cast<std::int32_t>(lossy & 1),
                                                   static_cast<std::int32_t>(lossy >> 1 & 1),
                                                   static_cast<std::int32_t>(lossy >> 2 & 1), 0};
  const auto least_side = hn::Load(d, least_sides);
  const auto below = sizeof(S) == 4 ? hn::Set(d, -most_above(map)) : least_side;
  const auto disorder = [&](const Record& r) {
    const auto lo = hn::LoadU(d, r.lo), hi = hn::LoadU(d, r.hi);
    return hn::Xor(hi, hn::Max(hn::Add(lo, below), hi));
  };
  auto any_disorder = hn::Zero(d);
  for (std::size_t i = 0; i < count; ++i) any_disorder = hn::Or(any_disorder, disorder(out[i]));
  if (HWY_LIKELY(!has_nan && is_zero_but_for_fourth(any_disorder))) return all;
  std::uint64_t valid = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bool is_right = !has_nan && is_zero_but_for_fourth(disorder(out[i]));
    if constexpr (sizeof(S) == 8) {
      const auto lo = hn::LoadU(d, out[i].lo), hi = hn::LoadU(d, out[i].hi);
      is_right =
          is_right || (!has_nan && is_zero_but_for_fourth(hn::Xor(hi, hn::Max(lo, hi))) && is_in_order(boxes[i]));
    }
    valid |= std::uint64_t{is_right || (has_nan && is_valid(boxes[i], out[i], most_above(map)))} << i;
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
      out[i].hi[d] = map.high(boxes[i].max[d], d);
      if constexpr (sizeof(S) == 8)
        if (map.loses_bits(boxes[i].min[d], d) || map.loses_bits(boxes[i].max[d], d)) map.lossy().add(1u << d);
    }
    out[i].id = first_id + static_cast<std::uint32_t>(i);
    out[i].before = 0;
    valid |= std::uint64_t{is_valid(boxes[i], out[i], most_above(map))} << i;
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
