// SPDX-License-Identifier: MIT
#include <algorithm>
#include <boxstream/near.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace boxstream {
namespace {

/// At least the exact value of what was rounded, once and in any mode, to `value`.
double up(double value) {
  return value + (std::abs(value) * 0x1p-50 + 4 * std::numeric_limits<double>::denorm_min());
}

void round_up(double value, double& to) {
  to = value;
}

void round_up(double value, float& to) {
  // A float in place of a double is off by less than 2^-23 of its value, or by the smallest denormal.
  to = static_cast<float>(value + (std::abs(value) * 0x1p-22 + 0x1p-148));
}

template <class S>
bool is_valid(const BasicBall<S>& ball) {
  return std::isfinite(ball.centre[0]) && std::isfinite(ball.centre[1]) && std::isfinite(ball.centre[2]) &&
         std::isfinite(ball.radius) && ball.radius >= 0;
}

/// Balls that are near have boxes that touch: on each axis the centres are at most a half size of each apart.
template <class S>
BasicAabb<S> box_around(const BasicBall<S>& ball, S distance) {
  constexpr S nan = std::numeric_limits<S>::quiet_NaN();
  if (!is_valid(ball)) return {{nan, nan, nan}, {nan, nan, nan}};
  const double half = up(double(ball.radius) + up(double(distance) / 2));
  BasicAabb<S> box;
  for (int d = 0; d < 3; ++d) {
    S below;
    round_up(up(half - double(ball.centre[d])), below);
    box.min[d] = -below;
    round_up(up(half + double(ball.centre[d])), box.max[d]);
  }
  return box;
}

template <class S>
Stats stream(Detector& detector, Span<const BasicBall<S>> balls, S distance, PairSink sink) {
  if (!(std::isfinite(distance) && distance >= 0))
    throw std::invalid_argument("boxstream: a distance must be finite and not below 0");
  std::vector<BasicAabb<S>> boxes(balls.size());
  std::transform(balls.begin(), balls.end(), boxes.begin(),
                 [&](const auto& ball) { return box_around(ball, distance); });
  std::vector<Pair> near;
  std::uint64_t delivered = 0;
  const auto keep_near = [&](Span<const Pair> pairs) {
    near.clear();
    for (const Pair pair : pairs)
      if (is_near(balls[pair.a], balls[pair.b], distance)) near.push_back(pair);
    delivered += near.size();
    return near.empty() || sink(near);
  };
  Stats stats = detector.stream_pairs(Span<const BasicAabb<S>>(boxes), keep_near);
  stats.pairs = delivered;
  return stats;
}

template <class S>
Stats find(Detector& detector, Span<const BasicBall<S>> balls, S distance, std::vector<Pair>& out) {
  out.clear();
  try {
    return stream<S>(detector, balls, distance, [&](Span<const Pair> pairs) {
      out.insert(out.end(), pairs.begin(), pairs.end());
      return true;
    });
  } catch (...) {
    out.clear();
    throw;
  }
}

}  // namespace

Stats find_near_pairs(Detector& detector, Span<const Ball> balls, float distance, std::vector<Pair>& out) {
  return find(detector, balls, distance, out);
}

Stats find_near_pairs(Detector& detector, Span<const Ball64> balls, double distance, std::vector<Pair>& out) {
  return find(detector, balls, distance, out);
}

Stats stream_near_pairs(Detector& detector, Span<const Ball> balls, float distance, PairSink sink) {
  return stream(detector, balls, distance, sink);
}

Stats stream_near_pairs(Detector& detector, Span<const Ball64> balls, double distance, PairSink sink) {
  return stream(detector, balls, distance, sink);
}

}  // namespace boxstream
