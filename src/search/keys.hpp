// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

namespace boxstream::detail {

// The engine compares coordinates as 32-bit integers, by maps that are monotone: x <= y implies key(x) <= key(y), so
// boxes that touch have keys that touch. Integers, because their comparison needs nothing from the floating-point
// environment: no rounding mode, no flush to zero and no trap can touch it.

/// One to one, but for -0 == +0.
inline std::int32_t order_key(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  if (bits == INT32_MIN) return 0;  // -0
  return bits ^ ((bits >> 31) & INT32_MAX);
}

inline std::int64_t order_key(double x) {
  const auto bits = std::bit_cast<std::int64_t>(x);
  if (bits == INT64_MIN) return 0;
  return bits ^ ((bits >> 63) & INT64_MAX);
}

template <class S>
inline constexpr auto infinity_key = sizeof(S) == 4 ? std::int64_t{0x7f800000} : std::int64_t{0x7ff0000000000000};

/// True unless a bound is NaN or min > max, without a floating-point comparison.
template <class S>
bool has_valid_keys(const BasicAabb<S>& box) {
  for (int d = 0; d < 3; ++d) {
    const auto lo = order_key(box.min[d]), hi = order_key(box.max[d]);
    if (lo > hi || lo < ~infinity_key<S> || hi > infinity_key<S>) return false;
  }
  return true;
}

/// Closed overlap of two valid boxes.
inline bool overlap_exactly(const BasicAabb<double>& a, const BasicAabb<double>& b) {
  for (int d = 0; d < 3; ++d)
    if (order_key(a.min[d]) > order_key(b.max[d]) || order_key(b.min[d]) > order_key(a.max[d])) return false;
  return true;
}

/// What the bits of a 32-bit key mean, for those who want to space keys evenly in the caller's coordinates.
enum class KeyKind : std::uint8_t {
  float32,  ///< an order key of a float
  float64,  ///< the upper half of an order key of a double
  linear,   ///< a window of order keys of doubles in which these grow about evenly
};

/// The map for one batch, so that equal axes of all its boxes are mapped alike.
template <class S>
class KeyMap;

/// Float: the key decides exactly.
template <>
class KeyMap<float> {
 public:
  void fit(Span<const BasicAabb<float>>) {}
  KeyKind kind(int) const { return KeyKind::float32; }
  std::int32_t operator()(float x, int) const { return order_key(x); }
};

/// Double: 32 bits of the order key, so that pairs found by keys have to be tested again. Which 32 depends on where the
/// boxes are: near the origin the leading ones; far from it, where these are all the same, a window around most boxes.
template <>
class KeyMap<double> {
 public:
  /// Chooses the windows for a set of boxes; may be called for two sets. Without it, the leading bits are used.
  void fit(Span<const BasicAabb<double>> boxes);

  KeyKind kind(int axis) const { return axes_[axis].shift < 0 ? KeyKind::float64 : KeyKind::linear; }

  std::int32_t operator()(double x, int axis) const {
    const Axis& a = axes_[axis];
    const std::int64_t key = order_key(x);
    if (a.shift < 0) return static_cast<std::int32_t>(key >> 32);
    const auto in_window = static_cast<std::uint64_t>(std::clamp(key, a.first, a.last) - a.first);
    return static_cast<std::int32_t>(static_cast<std::int64_t>(in_window >> a.shift) + INT32_MIN + 1);
  }

 private:
  struct Axis {
    std::int64_t lowest = INT64_MAX;  // where most boxes are
    std::int64_t highest = INT64_MIN;
    std::int64_t first = 0;  // of the window
    std::int64_t last = 0;
    int shift = -1;  // negative: no window
  };

  Axis axes_[3];
};

}  // namespace boxstream::detail
