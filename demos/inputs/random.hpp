// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace boxstream::batches {

/// Random numbers made of integer arithmetic and of +, *, sqrt on doubles only, which are exact or correctly rounded
/// everywhere: the distributions of <random> and the functions of libm differ between platforms.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// SplitMix64.
  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// Uniform in [0, 1).
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  /// Uniform in [low, high).
  double real(double low, double high) { return low + (high - low) * unit(); }

  /// Uniform among the integers low .. high; `low` if there are none. For |low|, |high| < 2^52.
  std::int64_t integer(std::int64_t low, std::int64_t high) {
    if (high <= low) return low;
    return low + static_cast<std::int64_t>(unit() * static_cast<double>(high - low + 1));
  }

  /// In [1, ratio), its logarithm uniform: each bit of a random exponent contributes the square root of the one before.
  double log_uniform(double ratio) {
    const std::uint64_t exponent = next();
    double value = 1;
    for (int bit = 0; bit < 24; ++bit) {
      ratio = std::sqrt(ratio);
      if ((exponent >> bit) & 1) value *= ratio;
    }
    return value;
  }

  /// Mean 0, variance 1: twelve uniforms added up, close enough to normal here and free of libm.
  double gaussian() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += unit();
    return sum;
  }

  template <class T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i)
      std::swap(values[i - 1], values[static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(i) - 1))]);
  }

 private:
  std::uint64_t state_;
};

/// Largest r with r^3 <= x, for x < 2^62. The guess is libm's, the result is not.
inline std::int64_t floor_cube_root(std::int64_t x) {
  auto r = static_cast<std::int64_t>(std::cbrt(static_cast<double>(x)));
  while (r * r * r > x) --r;
  while ((r + 1) * (r + 1) * (r + 1) <= x) ++r;
  return r;
}

/// Largest r with r^2 <= x, for x < 2^62.
inline std::int64_t floor_square_root(std::int64_t x) {
  auto r = static_cast<std::int64_t>(std::sqrt(static_cast<double>(x)));
  while (r * r > x) --r;
  while ((r + 1) * (r + 1) <= x) ++r;
  return r;
}

/// n^(1/3) to 20 bits, the same on every platform. For n < 2^31, at least 1.
inline double cube_root(std::size_t n) {
  const auto scaled = static_cast<std::int64_t>(n) << 30;
  return n == 0 ? 1.0 : static_cast<double>(floor_cube_root(scaled)) * 0x1p-10;
}

}  // namespace boxstream::batches
