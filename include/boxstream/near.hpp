// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cmath>
#include <limits>
#include <vector>

#include <boxstream/detail/export.hpp>
#include <boxstream/detector.hpp>

namespace boxstream {

/// A closed ball, in the caller's unit; a point where the radius is 0, and in the plane where all have the same z.
/// A ball with a coordinate or radius that is not finite, or with a radius below 0, is *invalid*: it is near nothing.
template <class S>
struct BasicBall {
  S centre[3];
  S radius;
};

using Ball = BasicBall<float>;
using Ball64 = BasicBall<double>;

namespace detail {
template <class S>
inline Ball64 in_doubles(const BasicBall<S>& ball) {
  return {{double(ball.centre[0]), double(ball.centre[1]), double(ball.centre[2])}, double(ball.radius)};
}
/// `is_near`, by integers alone.
BOXSTREAM_API bool near_exactly(const Ball64& a, const Ball64& b, double distance);
/// `is_near`, by sums in double if these can tell. Squares may overflow.
inline bool near_by_sums(const Ball64& p, const Ball64& q, double distance) {
  const double x = p.centre[0] - q.centre[0], y = p.centre[1] - q.centre[1], z = p.centre[2] - q.centre[2];
  const double reach = p.radius + q.radius + distance;
  const double apart = x * x + y * y + z * z, allowed = reach * reach;
  if (apart > 0x1p-960 || allowed > 0x1p-960) {
    if (apart > allowed * (1 + 0x1p-48)) return false;
    if (apart < allowed * (1 - 0x1p-48) && allowed <= std::numeric_limits<double>::max()) return true;
  }
  return near_exactly(p, q, distance);
}
/// False if a sum of squares might overflow.
inline bool squares_fit(const Ball64& p, const Ball64& q, double distance) {
  double largest = distance;
  for (const Ball64* ball : {&p, &q})
    for (const double x : {ball->centre[0], ball->centre[1], ball->centre[2], ball->radius})
      largest = std::abs(x) > largest ? std::abs(x) : largest;
  return largest < 0x1p509;
}
}  // namespace detail

/// True when the gap between two balls is at most `distance`: |a - b| <= a.radius + b.radius + distance, decided for
/// the numbers as they are given, without rounding, in any rounding mode. Valid balls and finite distance >= 0 only.
/// The distance is a double for balls of floats too: 0.1 is no float, and balls 0.1f apart are not within it.
/// Where the host has denormal numbers flushed (FTZ, DAZ), those of floats count as 0, and those of doubles may.
///
/// Why it is exact: both sides are squared, which makes it the sign of a polynomial of degree two. For coordinates of
/// 24 bits of similar size, as on a grid, doubles hold all its terms. In general they do not: the difference of two
/// floats can have 277 bits, and the square of one of 53 bits has 106. So the sums in double are a filter. Either is a
/// sum of terms >= 0 with at most six roundings in a row, hence off by less than 7 * 2^-52 of its value in any rounding
/// mode; where they differ by 16 * 2^-52 of it, the answer is theirs. All else (a distance that is met to 14 digits,
/// and numbers whose squares leave the range of normal doubles) is added up in integers as wide as it takes.
template <class S>
inline bool is_near(const BasicBall<S>& a, const BasicBall<S>& b, double distance) {
  const Ball64 p = detail::in_doubles(a), q = detail::in_doubles(b);
  // Those of floats do, but for the distance. Hosts may trap overflow, so nothing is squared to see.
  const bool fit = sizeof(S) == sizeof(double) ? detail::squares_fit(p, q, distance) : distance < 0x1p509;
  return fit ? detail::near_by_sums(p, q, distance) : detail::near_exactly(p, q, distance);
}

/// Fixed-radius near neighbours: every pair of balls for which `is_near`, each exactly once, and nothing else.
/// `detector` searches boxes around the balls, grown by half of `distance` and rounded outwards, so that no pair is
/// lost; `is_near` decides, with denormal numbers as they are, whatever the host does to them. Points within r of
/// each other: radius 0, distance r.
///
/// @par Order
/// As of `detector`; so are threads, sinks and limits. `is_near` runs on the calling thread. `Stats::pairs` are those
/// delivered, `Stats::invalid` invalid balls; all else is about boxes.
///
/// @par Memory
/// A box for each ball, for the time of the call, beside what the detector keeps.
///
/// @par Errors
/// std::invalid_argument unless `distance` is finite and >= 0; what the detector throws.
///
/// Made for radii of about the same size: boxes around a ball that is much larger than its neighbours have corners that
/// hold many of them. It does not give distances, and not the k nearest.
BOXSTREAM_API Stats find_near_pairs(Detector& detector, Span<const Ball> balls, double distance,
                                    std::vector<Pair>& out);
BOXSTREAM_API Stats find_near_pairs(Detector& detector, Span<const Ball64> balls, double distance,
                                    std::vector<Pair>& out);

/// The same pairs in the same order, passed to `sink` while they are found, in O(n) memory for any number of pairs.
BOXSTREAM_API Stats stream_near_pairs(Detector& detector, Span<const Ball> balls, double distance, PairSink sink);
BOXSTREAM_API Stats stream_near_pairs(Detector& detector, Span<const Ball64> balls, double distance, PairSink sink);

}  // namespace boxstream
