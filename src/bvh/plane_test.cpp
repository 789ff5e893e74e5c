// SPDX-License-Identifier: MIT
#include "bvh/plane_test.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include <boxstream/detail/float_environment.hpp>

namespace boxstream::detail {

namespace {

// Numbers are taken apart and scaled as integers, without rounding.

constexpr int bias = 1023;
constexpr int beyond_all = 0x7ff;  // the exponent field of infinity and NaN
constexpr std::uint64_t fraction_bits = (std::uint64_t{1} << 52) - 1;

/// (1 + fraction / 2^52) * 2^(exponent - bias), for finite numbers other than 0.
struct Magnitude {
  std::uint64_t fraction = 0;
  int exponent = 0;
  bool is_zero = true;
  bool is_negative = false;

  bool is_infinite() const { return exponent == beyond_all && fraction == 0; }
  bool is_nan() const { return exponent == beyond_all && fraction != 0; }
};

Magnitude decompose(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  Magnitude m;
  m.is_negative = bits >> 63 != 0;
  m.is_zero = bits << 1 == 0;
  m.fraction = bits & fraction_bits;
  m.exponent = static_cast<int>(bits >> 52 & beyond_all);
  if (m.exponent != 0 || m.is_zero) return m;
  const auto denormal = std::bit_cast<std::uint64_t>(static_cast<double>(m.fraction));
  m.fraction = denormal & fraction_bits;
  m.exponent = static_cast<int>(denormal >> 52) - (bias + 51);
  return m;
}

double put_together(const Magnitude& m, int shift) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(m.exponent + shift) << 52 | m.fraction);
}

constexpr double widen = 1 + 0x1p-48, narrow = 1 - 0x1p-48;
constexpr double tiny = 0x1p-300;
constexpr int exponent_of_tiny = bias - 300;
/// The largest component is scaled to 1/16 or more and less than 1/8, so that the terms of three finite coordinates
/// stay below `huge`.
constexpr int exponent_of_largest = bias - 4;
constexpr double huge = 0x1p1023;
constexpr int exponent_of_huge = bias + 1023;

}  // namespace

template <class S>
PlaneTest::PlaneTest(const BasicPlane<S>& plane) {
  const DefaultFloatEnvironment environment;  // a denormal float is a number of its own as a double
  const Magnitude offset = decompose(plane.offset);
  Magnitude normal[3];
  int largest = std::numeric_limits<int>::min();
  for (int d = 0; d < 3; ++d) {
    normal[d] = decompose(plane.normal[d]);
    if (normal[d].exponent == beyond_all) return;
    if (!normal[d].is_zero) largest = std::max(largest, normal[d].exponent);
  }
  if (offset.is_nan() || (offset.is_infinite() && !offset.is_negative)) return;
  if (largest == std::numeric_limits<int>::min()) {
    offset_ = offset.is_negative && !offset.is_zero ? -1 : 0;
    return;
  }

  const int shift = exponent_of_largest - largest;
  const bool is_huge = offset.is_infinite() || offset.exponent + shift >= exponent_of_huge;
  const bool is_tiny = !is_huge && offset.exponent + shift < 2 * exponent_of_tiny - bias;
  if (is_huge && !offset.is_negative && !offset.is_zero) return;
  if (is_huge)
    offset_ = -huge;
  else if (!offset.is_zero && offset.is_negative)
    offset_ = is_tiny ? 0 : -put_together(offset, shift) * narrow;
  else if (!offset.is_zero)
    offset_ = is_tiny ? tiny * tiny : put_together(offset, shift) * widen;
  for (int d = 0; d < 3; ++d) {
    if (normal[d].is_zero) continue;
    const bool is_small = normal[d].exponent + shift < exponent_of_tiny;
    more_[d] = is_small ? tiny : put_together(normal[d], shift) * widen;
    less_[d] = is_small ? 0 : put_together(normal[d], shift) * narrow;
    up_[d] = !normal[d].is_negative;
  }
}

template PlaneTest::PlaneTest(const BasicPlane<float>&);
template PlaneTest::PlaneTest(const BasicPlane<double>&);

}  // namespace boxstream::detail

namespace boxstream {

template <class S>
bool is_behind(const BasicAabb<S>& box, const BasicPlane<S>& plane) {
  return detail::PlaneTest(plane).has_behind(box);
}

template bool is_behind(const BasicAabb<float>&, const BasicPlane<float>&);
template bool is_behind(const BasicAabb<double>&, const BasicPlane<double>&);

}  // namespace boxstream
