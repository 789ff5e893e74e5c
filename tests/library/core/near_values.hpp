// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/near.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "random.hpp"

/// Which balls are near each other, in integers that hold everything, and balls whose nearness is hard to tell.
namespace boxstream::tests {

__extension__ using Int128 = __int128;

inline constexpr int fraction_bits = 30;

/// The truth for numbers that are multiples of 2^-30 below 2^30: squares of their sums fit into 124 bits.
template <class S>
bool truly_near(const BasicBall<S>& a, const BasicBall<S>& b, S distance) {
  const auto whole = [](S value) { return static_cast<Int128>(std::ldexp(double(value), fraction_bits)); };
  const Int128 reach = whole(a.radius) + whole(b.radius) + whole(distance);
  Int128 apart = 0;
  for (int d = 0; d < 3; ++d) {
    const Int128 difference = whole(a.centre[d]) - whole(b.centre[d]);
    apart += difference * difference;
  }
  return apart <= reach * reach;
}

/// Any float that `truly_near` can take, its exponent random in a range that the square of a double cannot hold.
inline float any_float(Random& random, bool negative = true) {
  const int bits = random.integer(1, 24), shift = random.integer(-fraction_bits, 30 - bits);
  const auto whole = static_cast<float>(random.index((std::size_t{1} << bits) - 1) + 1);
  const float value = std::ldexp(whole, std::min(shift, 5));
  return random.chance(0.1) ? 0 : negative && random.chance(0.5) ? -value : value;
}

inline Ball any_ball(Random& random) {
  return {{any_float(random), any_float(random), any_float(random)}, any_float(random, false)};
}

/// Sides of boxes with a whole diagonal: x, y, z and the diagonal.
inline constexpr int whole_diagonals[][4] = {
    {3, 4, 0, 5}, {5, 12, 0, 13},  {8, 15, 0, 17},  {20, 21, 0, 29},    {1, 2, 2, 3},         {2, 3, 6, 7},
    {1, 4, 8, 9}, {4, 4, 7, 9},    {2, 6, 9, 11},   {6, 6, 7, 11},      {3, 4, 12, 13},       {7, 0, 0, 7},
    {0, 0, 0, 0}, {2, 10, 11, 15}, {1, 12, 12, 17}, {696, 697, 0, 985}, {4059, 4060, 0, 5741}};

template <class S>
struct Touching {
  BasicBall<S> a, b;
  S distance;
};

/// Two balls exactly `distance` apart: sides of a whole diagonal, scaled, turned, moved, with parts of the diagonal as
/// radii.
template <class S>
Touching<S> touching(Random& random, int exponent) {
  const int(&sides)[4] = whole_diagonals[random.index(std::size(whole_diagonals))];
  Touching<S> t{};
  const std::size_t turn = random.index(3);
  for (std::size_t d = 0; d < 3; ++d) {
    const int from = random.integer(-3000, 3000);
    t.a.centre[d] = std::ldexp(S(from), exponent);
    t.b.centre[d] = std::ldexp(S(from + (random.chance(0.5) ? 1 : -1) * sides[(d + turn) % 3]), exponent);
  }
  const int first = random.integer(0, sides[3]), second = random.integer(0, sides[3] - first);
  t.a.radius = std::ldexp(S(first), exponent);
  t.b.radius = std::ldexp(S(second), exponent);
  t.distance = std::ldexp(S(sides[3] - first - second), exponent);
  return t;
}

}  // namespace boxstream::tests
