// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
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

/// Whether boxes that share no more than a face, an edge or a corner are pairs.
enum class Faces : std::uint8_t { closed, open };

/// What is taken off the key of a high end where keys are one to one, so that a.lo <= b.hi becomes a.lo < b.hi. A flat
/// open box has a key less at its high end than at its low end.
template <class Key = std::int32_t>
constexpr Key off_high(Faces faces) {
  return faces == Faces::open ? 1 : 0;
}

/// Whether two valid boxes overlap. Most pairs that get here do, so leaving early after one axis gains nothing.
inline bool overlap_exactly(const BasicAabb<double>& a, const BasicAabb<double>& b, Faces faces) {
  const auto off = off_high<std::int64_t>(faces);
  int apart = 0;
  for (int d = 0; d < 3; ++d) {
    apart |= order_key(a.min[d]) > order_key(b.max[d]) - off ? 1 : 0;
    apart |= order_key(b.min[d]) > order_key(a.max[d]) - off ? 1 : 0;
  }
  return apart == 0;
}

/// What the bits of a 32-bit key mean, for code that spaces keys evenly in the caller's coordinates.
enum class KeyKind : std::uint8_t {
  float32,  ///< an order key of a float
  float64,  ///< the upper half of an order key of a double
  linear,   ///< grows evenly where most boxes are
};

/// The axes of a batch, a bit each, on which a coordinate lost bits on its way to a key. On all others a key says as
/// much as the number. Every thread that makes keys adds its bits; the set is complete once all keys are made.
class LossyAxes {
 public:
  static constexpr std::uint32_t every = 7;

  void add(std::uint32_t axes) const {
    if ((axes & ~axes_.load(std::memory_order_relaxed)) != 0) axes_.fetch_or(axes, std::memory_order_relaxed);
  }
  std::uint32_t all() const { return axes_.load(std::memory_order_relaxed); }

 private:
  mutable std::atomic<std::uint32_t> axes_{0};
};

/// The map for one batch, so that equal axes of all its boxes are mapped alike.
template <class S>
class KeyMap;

/// Float: the key decides exactly.
template <>
class KeyMap<float> {
 public:
  explicit KeyMap(Faces faces = Faces::closed, KeyKind kind = KeyKind::float32) : faces_(faces), kind_(kind) {}

  void fit(Span<const BasicAabb<float>>, Span<const BasicAabb<float>> = {}) {}
  KeyKind kind(int) const { return kind_; }
  std::int32_t operator()(float x, int) const { return order_key(x); }
  /// Of a high end.
  std::int32_t high(float x, int) const {
    // The key of a NaN may be the lowest number.
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(order_key(x)) - off_high<std::uint32_t>(faces_));
  }
  Faces faces() const { return faces_; }

 private:
  Faces faces_;
  KeyKind kind_;
};

/// Double: keys of 32 bits, so a pair that is found by equal keys is tested again on each axis where bits were lost.
/// Which 32 bits depends, axis by axis,
/// on where the boxes are: fixed-point numbers in a window around most of them, with fewer bits of the order key beyond
/// it; or, if too many boxes would be flattened by that, the leading bits of the order key.
template <>
class KeyMap<double> {
 public:
  /// Open boxes that share a key are compared again, on all axes.
  explicit KeyMap(Faces faces = Faces::closed) {
    set_leading_bits();
    if (faces == Faces::open) lossy_.add(LossyAxes::every);
  }

  /// Chooses the windows for a set of boxes, or two. Without it, the leading bits are used.
  void fit(Span<const BasicAabb<double>> a, Span<const BasicAabb<double>> b = {});

  KeyKind kind(int axis) const { return leading_[axis] != 0 ? KeyKind::float64 : KeyKind::linear; }

  std::int32_t operator()(double x, int axis) const {
    const std::int64_t key = order_key(x);
    return leading_[axis] != 0 ? static_cast<std::int32_t>(key >> 32) : window_key(key, axis);
  }
  std::int32_t high(double x, int axis) const { return (*this)(x, axis); }

  /// Whether other numbers have the key of this one. A window takes multiples of a power of two as they are.
  bool loses_bits(double x, int axis) const {
    const std::int64_t key = order_key(x), sign = key >> 63, magnitude = key ^ sign;
    if (leading_[axis] != 0) return (magnitude & UINT32_MAX) != 0;
    const std::int64_t at = fixed_point(key, axis), exponent = std::max(magnitude >> 52, std::int64_t{1});
    if (at < first_[axis] || at > last_[axis]) return true;
    const std::int64_t below_top = std::min(top_[axis] - exponent, std::int64_t{63});
    const std::uint64_t below = (std::uint64_t{1} << below_top) - 1;
    return (static_cast<std::uint64_t>(fraction_of(magnitude) << headroom) & below) != 0 ||
           (static_cast<std::uint64_t>(at - first_[axis]) & ((std::uint64_t{1} << shift_[axis]) - 1)) != 0;
  }
  const LossyAxes& lossy() const { return lossy_; }

  // For vectors of up to eight lanes: low ends on x, y and z, any one, high ends on x, y and z, any one.
  static constexpr std::size_t lanes = 8;
  /// Of the coordinate in each lane: the largest magnitude of a fixed-point number, as bits of a double, and its
  /// exponent; the window; how many bits of a number in it are left out; all ones for leading bits instead.
  const std::int64_t* most() const { return most_; }
  const std::int64_t* top() const { return top_; }
  const std::int64_t* first() const { return first_; }
  const std::int64_t* last() const { return last_; }
  const std::uint64_t* shift() const { return shift_; }
  const std::int32_t* leading() const { return leading_; }
  bool has_leading() const { return (leading_[0] | leading_[1] | leading_[2]) != 0; }

  static constexpr std::int64_t hidden_bit = std::int64_t{1} << 52;
  static constexpr int headroom = 9;  // of a fixed-point number: bits below the fraction of the largest
  // Keys of a window begin at -outer / 2 and end before outer / 2. Beyond it, leading bits of the order key and -outer
  // or outer.
  static constexpr int outer_shift = 34;
  static constexpr std::int32_t outer = std::int32_t{1} << 30;

 private:
  static std::int64_t fraction_of(std::int64_t magnitude) {
    return (magnitude & (hidden_bit - 1)) | (magnitude >= hidden_bit ? hidden_bit : std::int64_t{0});
  }

  /// An order key in fixed point, in fractions of the last place of the largest; larger keys become the largest.
  std::int64_t fixed_point(std::int64_t key, int axis) const {
    const std::int64_t sign = key >> 63, magnitude = std::min(key ^ sign, most_[axis]);
    const std::int64_t exponent = std::max(magnitude >> 52, std::int64_t{1});
    return ((fraction_of(magnitude) << headroom >> std::min(top_[axis] - exponent, std::int64_t{63})) ^ sign) - sign;
  }

  std::int32_t window_key(std::int64_t key, int axis) const {
    const std::int64_t at = fixed_point(key, axis);
    if (at < first_[axis]) return static_cast<std::int32_t>(key >> outer_shift) - outer;
    if (at > last_[axis]) return static_cast<std::int32_t>(key >> outer_shift) + outer;
    return static_cast<std::int32_t>(static_cast<std::uint64_t>(at - first_[axis]) >> shift_[axis]) - outer / 2;
  }

  void set_leading_bits();
  void set_window(std::int64_t lowest_key, std::int64_t highest_key, int axis);
  bool loses_extents(Span<const std::int64_t> ends, int axis) const;

  alignas(64) std::int64_t most_[lanes], top_[lanes], first_[lanes], last_[lanes];
  alignas(64) std::uint64_t shift_[lanes];
  alignas(64) std::int32_t leading_[lanes];
  LossyAxes lossy_;
};

}  // namespace boxstream::detail
