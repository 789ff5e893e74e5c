// SPDX-License-Identifier: MIT
//
// Structures whose words stand in memory four by four, such as boxes and records, read as columns: a lane each.

#if defined(BOXSTREAM_QUADRUPLES_INL_HPP_) == defined(HWY_TARGET_TOGGLE)  // once per SIMD target
#ifdef BOXSTREAM_QUADRUPLES_INL_HPP_
#undef BOXSTREAM_QUADRUPLES_INL_HPP_
#else
#define BOXSTREAM_QUADRUPLES_INL_HPP_
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace boxstream::detail {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET == HWY_SCALAR

template <class DK, class T>
HWY_INLINE void load_columns_of(DK d, const T* from, std::size_t last, int first, hn::VFromD<DK> (&columns)[4]) {
  (void)last;
  for (int i = 0; i < 4; ++i) columns[i] = hn::LoadU(d, reinterpret_cast<const std::int32_t*>(from) + first + i);
}
template <class DK, class T>
HWY_INLINE hn::VFromD<DK> load_fourth_column_of(DK d, const T* from, std::size_t last, int first) {
  (void)last;
  return hn::LoadU(d, reinterpret_cast<const std::int32_t*>(from) + first + 3);
}

#else

/// Four words, from `first` on, of every fourth structure from the one at `i` on; of the last rather than of any
/// beyond.
template <class DK, class T>
HWY_INLINE hn::VFromD<DK> load_every_fourth(DK d, const T* from, std::size_t i, std::size_t last, int first) {
  if constexpr (hn::MaxLanes(DK()) == 4) {
    return hn::LoadU(d, reinterpret_cast<const std::int32_t*>(from + std::min(i, last)) + first);
  } else {
    const hn::Half<DK> half;
    return hn::Combine(d, load_every_fourth(half, from, i + hn::MaxLanes(half), last, first),
                       load_every_fourth(half, from, i, last, first));
  }
}

/// Four words, from `first` on, of as many structures as there are lanes; lanes behind the last repeat it.
template <class DK, class T>
HWY_INLINE void load_columns_of(DK d, const T* from, std::size_t last, int first, hn::VFromD<DK> (&columns)[4]) {
  const hn::RepartitionToWide<DK> d64;
  const auto wide = [&](auto v) HWY_ATTR { return hn::BitCast(d64, v); };
  const auto row = [&](std::size_t i) HWY_ATTR { return load_every_fourth(d, from, i, last, first); };
  const auto r0 = row(0), r1 = row(1), r2 = row(2), r3 = row(3);
  const auto low01 = wide(hn::InterleaveLower(d, r0, r1)), low23 = wide(hn::InterleaveLower(d, r2, r3));
  const auto up01 = wide(hn::InterleaveUpper(d, r0, r1)), up23 = wide(hn::InterleaveUpper(d, r2, r3));
  columns[0] = hn::BitCast(d, hn::InterleaveLower(d64, low01, low23));
  columns[1] = hn::BitCast(d, hn::InterleaveUpper(d64, low01, low23));
  columns[2] = hn::BitCast(d, hn::InterleaveLower(d64, up01, up23));
  columns[3] = hn::BitCast(d, hn::InterleaveUpper(d64, up01, up23));
}

/// The last of them alone.
template <class DK, class T>
HWY_INLINE hn::VFromD<DK> load_fourth_column_of(DK d, const T* from, std::size_t last, int first) {
  const hn::RepartitionToWide<DK> d64;
  const auto row = [&](std::size_t i) HWY_ATTR { return load_every_fourth(d, from, i, last, first); };
  const auto up01 = hn::InterleaveUpper(d, row(0), row(1)), up23 = hn::InterleaveUpper(d, row(2), row(3));
  return hn::BitCast(d, hn::InterleaveUpper(d64, hn::BitCast(d64, up01), hn::BitCast(d64, up23)));
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace boxstream::detail
HWY_AFTER_NAMESPACE();

#endif
