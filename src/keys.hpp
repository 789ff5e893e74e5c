// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

#include <boxstream/aabb.hpp>

namespace boxstream::detail {

/// The engine compares coordinates as 32-bit integers. `order_key` is monotone: x <= y implies key(x) <= key(y), so
/// boxes that touch have keys that touch. For float it is one to one as well (but for -0 == +0), so the keys decide
/// exactly; for double it keeps the leading 32 bits, and pairs found by keys are tested again in double.
/// Integers, because their comparison needs nothing from the floating-point environment: no rounding mode, no flush to
/// zero and no trap can touch it.
inline std::int32_t order_key(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  if (bits == INT32_MIN) return 0;  // -0
  return bits ^ ((bits >> 31) & INT32_MAX);
}

inline std::int64_t order_key_64(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  if (bits == INT64_MIN) return 0;
  return bits ^ ((bits >> 63) & INT64_MAX);
}

inline std::int32_t order_key(double x) {
  return static_cast<std::int32_t>(order_key_64(x) >> 32);
}

/// The number with that key, or, for double, the smallest in magnitude order that shares it; always finite if the key
/// is within `finite_keys`. Monotone.
template <class S>
inline double key_value(std::int32_t key);

template <>
inline double key_value<float>(std::int32_t key) {
  return std::bit_cast<float>(key ^ ((key >> 31) & INT32_MAX));
}

template <>
inline double key_value<double>(std::int32_t key) {
  const std::int64_t wide = std::int64_t{key} << 32;
  return std::bit_cast<double>(wide ^ ((wide >> 63) & INT64_MAX));
}

/// Largest key of a finite number that `key_value` gives back finite; the smallest is its complement.
template <class S>
inline constexpr std::int32_t largest_finite_key = sizeof(S) == 4 ? 0x7f7fffff : 0x7fefffff;

/// True unless a bound is NaN or min > max, without a floating-point comparison.
inline bool has_valid_keys(const BasicAabb<float>& box) {
  constexpr std::int32_t inf = 0x7f800000;
  for (int d = 0; d < 3; ++d) {
    const std::int32_t lo = order_key(box.min[d]), hi = order_key(box.max[d]);
    if (lo > hi || lo < ~inf || hi > inf) return false;
  }
  return true;
}

inline bool has_valid_keys(const BasicAabb<double>& box) {
  constexpr std::int64_t inf = 0x7ff0000000000000;
  for (int d = 0; d < 3; ++d) {
    const std::int64_t lo = order_key_64(box.min[d]), hi = order_key_64(box.max[d]);
    if (lo > hi || lo < ~inf || hi > inf) return false;
  }
  return true;
}

/// Closed overlap of two valid double boxes, decided on their full keys.
inline bool overlap_exactly(const BasicAabb<double>& a, const BasicAabb<double>& b) {
  for (int d = 0; d < 3; ++d)
    if (order_key_64(a.min[d]) > order_key_64(b.max[d]) || order_key_64(b.min[d]) > order_key_64(a.max[d]))
      return false;
  return true;
}

}  // namespace boxstream::detail
