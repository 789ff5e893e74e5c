// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <boxstream/aabb.hpp>

namespace boxstream::detail {

/// The neighbour below a finite x >= 0; nothing is below zero.
template <class S>
S next_below(S x) {
  using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
  return x > 0 ? std::bit_cast<S>(std::bit_cast<Bits>(x) - 1) : S(0);
}

/// x - y rounded down, for x > y; never infinite. For others it is some number.
template <class S>
S difference_below(S x, S y) {
  using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;
  const S d = x - y;
  // d and the error of the subtraction, which is a number itself, make the exact difference. (If d is infinite the
  // error is NaN.)
  const S y_seen = x - d;
  const S error = (x - (d + y_seen)) + (y_seen - y);
  const S below = std::bit_cast<S>(std::bit_cast<Bits>(d) - static_cast<Bits>((error < 0) & (d > 0)));
  return d <= std::numeric_limits<S>::max() ? below : std::numeric_limits<S>::max();
}

/// The root of a sum of squares, rounded down; `lengths` are >= 0 and their squares neither overflow nor vanish.
inline double norm_below(const double (&lengths)[3]) {
  const double x = lengths[0] * lengths[0], y = lengths[1] * lengths[1], z = lengths[2] * lengths[2];
  const double xy = x + y;
  const double sum = xy + z;
  const double root = std::sqrt(sum);
  // Numbers of few digits, such as 3, 4 and 5, are squared and added without error: what is exact stays exact.
  const auto is_short = [](double v) { return static_cast<double>(static_cast<float>(v)) == v; };
  if (is_short(root) && root * root == sum && is_short(lengths[0]) && is_short(lengths[1]) && is_short(lengths[2]) &&
      xy - x == y && xy - y == x && sum - xy == z && sum - z == xy)
    return root;
  // Seven roundings, most of them halved by the root.
  return root * (1 - 8 * std::numeric_limits<double>::epsilon());
}

inline float norm_below(const float (&lengths)[3]) {
  const double wide[3] = {lengths[0], lengths[1], lengths[2]};
  const double norm = norm_below(wide);
  const auto narrow = static_cast<float>(norm);
  return static_cast<double>(narrow) > norm ? next_below(narrow) : narrow;
}

/// The same for lengths of any size, scaled so that squares neither overflow nor underflow. By products with powers of
/// two, which round as `ldexp` does: some C libraries compute that in other registers, with other flags.
inline double norm_below_scaled(const double (&lengths)[3], double largest) {
  const double factor = largest > 1 ? 0x1p-600 : 0x1p600, inverse = 1 / factor;
  double scaled[3];
  for (int d = 0; d < 3; ++d) scaled[d] = lengths[d] * factor;
  const double norm = norm_below(scaled);
  const double back = norm * inverse;
  if (!(back <= std::numeric_limits<double>::max())) return std::numeric_limits<double>::max();
  return back * factor > norm ? next_below(back) : back;
}

/// A lower bound of the distance of two valid boxes, at most some units in the last place below it. It is 0 if they
/// touch, and the largest finite number at most. Boxes with infinite bounds are as far apart as they are on the other
/// axes, if they overlap on this one.
template <class S>
S distance_below(const BasicAabb<S>& a, const BasicAabb<S>& b) {
  S gaps[3];
  S largest = 0;
  int separated_axes = 0;
  // Without branches: which box is the lower one is unpredictable.
  for (int d = 0; d < 3; ++d) {
    const bool a_first = a.max[d] < b.min[d];
    const bool b_first = b.max[d] < a.min[d];
    const S gap = difference_below(a_first ? b.min[d] : a.min[d], a_first ? a.max[d] : b.max[d]);
    gaps[d] = (a_first | b_first) ? gap : S(0);
    separated_axes += a_first | b_first;
    largest = gaps[d] > largest ? gaps[d] : largest;
  }
  if (separated_axes <= 1 || largest == std::numeric_limits<S>::max()) return largest;
  if constexpr (sizeof(S) == 4) {
    return norm_below(gaps);
  } else {
    return largest > 1e-140 && largest < 1e150 ? norm_below(gaps) : norm_below_scaled(gaps, largest);
  }
}

/// A limit below which distances are wanted. It is compared by integers, which work in any floating-point environment:
/// numbers that are not negative have the order of their bits.
template <class S>
class NearLimit {
 public:
  using Bits = std::conditional_t<sizeof(S) == 4, std::uint32_t, std::uint64_t>;

  explicit NearLimit(S limit) { set(limit); }

  /// Anything; zero, less and NaN leave nothing.
  void set(S limit) {
    const Bits bits = bits_of(limit);
    limit_ = bits <= infinite ? bits : 0;
    if (limit_ == 0) {
      reach_ = inside_ = 0;
    } else if (limit_ < most) {
      const Bits square = square_of(std::max(limit_, least));
      reach_ = square + slack;
      inside_ = limit_ > least ? square - slack : 0;
    } else {
      reach_ = infinite;
      inside_ = square_of(most) - slack;
    }
  }
  /// What was set last.
  bool is(S limit) const { return bits_of(limit) == limit_; }

  /// For comparing with a later value.
  Bits bits() const { return limit_; }
  bool is_over() const { return limit_ == 0; }
  /// False for those that keep nothing away, as the largest number does not.
  bool is_finite() const { return reach_ != infinite; }
  bool is_above(S distance) const { return bits_of(distance) < limit_; }

  /// Boxes at a distance below the limit have a squared one of at most this, in plain arithmetic: there is enough room
  /// for its errors that no box is lost.
  S reach() const { return std::bit_cast<S>(reach_); }
  bool reaches(S squared) const { return bits_of(squared) <= reach_; }
  /// True if boxes with such a squared distance, in plain arithmetic, are certainly at one below the limit.
  bool is_clearly_above(S squared) const { return bits_of(squared) < inside_; }

 private:
  static constexpr Bits bits_of(S x) { return std::bit_cast<Bits>(x); }

  static constexpr Bits infinite = bits_of(std::numeric_limits<S>::infinity());
  // Between these, squares neither overflow nor vanish.
  static constexpr Bits least = bits_of(sizeof(S) == 4 ? S(1e-15) : S(1e-140));
  static constexpr Bits most = bits_of(sizeof(S) == 4 ? S(1e19) : S(1e154));
  // In units of the last place of a square: 64 roundings, and of doubles what `square_of` leaves out.
  static constexpr Bits slack = sizeof(S) == 4 ? Bits{1} << 7 : Bits(std::uint64_t{1} << 24);

  /// Of the leading 32 bits, rounded down.
  static constexpr Bits square_of(Bits bits) {
    constexpr int fraction = std::numeric_limits<S>::digits - 1, kept = fraction < 31 ? fraction : 31;
    constexpr Bits hidden = Bits{1} << fraction, bias = std::numeric_limits<S>::max_exponent - 1;
    const std::uint64_t leading = (bits & (hidden - 1)) >> (fraction - kept) | std::uint64_t{1} << kept;
    const std::uint64_t square = leading * leading;
    const auto carry = static_cast<int>(square >> (2 * kept + 1));
    const auto significant = static_cast<Bits>(square << (1 - carry) >> (2 * kept + 1 - fraction));
    return (2 * (bits >> fraction) - bias + static_cast<Bits>(carry) - 1) * hidden + significant;
  }

  Bits limit_ = 0;
  Bits reach_ = 0;
  Bits inside_ = 0;
};

}  // namespace boxstream::detail
