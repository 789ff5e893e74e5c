// SPDX-License-Identifier: MIT
#include <boxstream/near.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <stdexcept>

#include <boxstream/detail/float_environment.hpp>

#include "base/empty_or_whole.hpp"

namespace boxstream {
namespace {

using namespace detail;

/// At least the exact value of what was rounded, in any mode, to `value`; denormals may have been rounded before, or
/// flushed to zero.
template <class S>
S up(S value) {
  using Limits = std::numeric_limits<S>;
  return value + (std::abs(value) * (4 * Limits::epsilon()) + 4 * Limits::min());
}

/// Balls that are near have boxes that touch: on each axis the centres are at most a half size of each apart.
template <class S>
BasicAabb<S> box_around(const BasicBall<S>& ball, S half_distance) {
  // x - x is 0 if x is finite, else NaN; a NaN makes the box invalid. Without branches, for vectors.
  S zero = ball.radius >= 0 ? ball.radius - ball.radius : std::numeric_limits<S>::quiet_NaN();
  for (const S x : ball.centre) zero += x - x;
  const S half = up(ball.radius + half_distance) + zero;
  BasicAabb<S> box;
  for (int d = 0; d < 3; ++d) {
    box.min[d] = -up(half - ball.centre[d]);
    box.max[d] = up(half + ball.centre[d]);
  }
  return box;
}

template <class S>
void keep_near_ones(Span<const BasicBall<S>> balls, double distance, Span<const Pair> pairs, std::vector<Pair>& near) {
  const DefaultFloatEnvironment environment;
  near.clear();
  for (const Pair pair : pairs)
    if (near_by_sums(in_doubles(balls[pair.a]), in_doubles(balls[pair.b]), distance)) near.push_back(pair);
}

/// By its bits: to compare a signalling NaN traps.
bool is_finite_and_not_below_zero(double distance) {
  constexpr std::uint64_t infinity = 0x7ff0000000000000, minus_zero = 0x8000000000000000;
  std::uint64_t bits = 0;
  std::memcpy(&bits, &distance, sizeof bits);
  return bits < infinity || bits == minus_zero;
}

template <class S>
Stats stream(Detector& detector, Span<const BasicBall<S>> balls, double distance, PairSink sink) {
  if (!is_finite_and_not_below_zero(distance))
    throw std::invalid_argument("boxstream: a distance must be finite and not below 0");
  // libc++ before 16 has no make_unique_for_overwrite.
  const std::unique_ptr<BasicAabb<S>[]> boxes(new BasicAabb<S>[balls.size()]);
  {
    const DefaultFloatEnvironment environment;
    const volatile double read_here = distance;             // or a compiler may round it before the environment is set
    const S half_distance = static_cast<S>(read_here / 2);  // beyond the range infinite, and then the boxes too
    for (std::size_t i = 0; i < balls.size(); ++i) boxes[i] = box_around(balls[i], half_distance);
  }
  std::vector<Pair> near;
  std::uint64_t delivered = 0;
  const auto keep_near = [&](Span<const Pair> pairs) {
    keep_near_ones(balls, distance, pairs, near);
    delivered += near.size();
    return near.empty() || sink(near);
  };
  Stats stats = detector.stream_pairs(Span<const BasicAabb<S>>(boxes.get(), balls.size()), keep_near);
  stats.pairs = delivered;
  return stats;
}

template <class S>
Stats find(Detector& detector, Span<const BasicBall<S>> balls, double distance, std::vector<Pair>& out) {
  EmptyOrWhole output(out);
  const Stats stats = stream<S>(detector, balls, distance, [&](Span<const Pair> pairs) {
    out.insert(out.end(), pairs.begin(), pairs.end());
    return true;
  });
  output.is_whole();
  return stats;
}

}  // namespace

Stats find_near_pairs(Detector& detector, Span<const Ball> balls, double distance, std::vector<Pair>& out) {
  return find(detector, balls, distance, out);
}

Stats find_near_pairs(Detector& detector, Span<const Ball64> balls, double distance, std::vector<Pair>& out) {
  return find(detector, balls, distance, out);
}

Stats stream_near_pairs(Detector& detector, Span<const Ball> balls, double distance, PairSink sink) {
  return stream(detector, balls, distance, sink);
}

Stats stream_near_pairs(Detector& detector, Span<const Ball64> balls, double distance, PairSink sink) {
  return stream(detector, balls, distance, sink);
}

}  // namespace boxstream
