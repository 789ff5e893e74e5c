// SPDX-License-Identifier: MIT
#include "world/fences/motion.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::detail {

namespace {

// Of steps between zero and a largest one, the largest to the root of the mean square; and a little more.
constexpr double most_to_mean = 1.85;

// For this and more it does not matter how many.
constexpr double many_sides = 1000;

}  // namespace

template <class S>
void Motion<S>::sample(const ProxyTable<S>& proxies) {
  last_.resize(sampled(proxies.ranks()));
  const std::size_t stride = proxies.ranks() / std::max<std::size_t>(last_.size(), 1);
  for (std::size_t i = 0; i < last_.size(); ++i) last_[i] = proxies.box(static_cast<std::uint32_t>(i * stride));
}

template <class S>
void Motion<S>::look(const ProxyTable<S>& proxies) {
  const std::size_t samples = sampled(proxies.ranks());
  const std::size_t stride = proxies.ranks() / std::max<std::size_t>(samples, 1);
  const auto at = [&](std::size_t i) { return proxies.box(static_cast<std::uint32_t>(i * stride)); };
  std::size_t count = 0;
  AxisSums sums[3];
  for (std::size_t i = 0; last_.size() == samples && i < samples; ++i) {
    const Box from = last_[i], to = at(i);
    if (!is_moderate(from) || !is_moderate(to)) continue;
    ++count;
    for (int d = 0; d < 3; ++d) {
      const double went = static_cast<double>(to.min[d]) - static_cast<double>(from.min[d]);
      sums[d].went += went;
      sums[d].went_any += std::abs(went);
      sums[d].side += static_cast<double>(to.max[d]) - static_cast<double>(to.min[d]);
    }
  }
  for (int d = 0; d < 3; ++d) {
    const bool is_common = count != 0 && 2 * std::abs(sums[d].went) > sums[d].went_any;
    common_[d] = is_common ? static_cast<S>(sums[d].went / static_cast<double>(count)) : S{0};
  }
  for (std::size_t i = 0; count != 0 && i < samples; ++i) {
    const Box from = last_[i], to = at(i);
    if (!is_moderate(from) || !is_moderate(to)) continue;
    for (int d = 0; d < 3; ++d) {
      const double beyond =
          static_cast<double>(to.min[d]) - static_cast<double>(from.min[d]) - static_cast<double>(common_[d]);
      const double side = static_cast<double>(to.max[d]) - static_cast<double>(to.min[d]);
      sums[d].squares += beyond * beyond;
      const double in_sides = std::min(std::abs(beyond), many_sides * side) / side;
      if (beyond != 0) sums[d].in_sides += side > 0 ? in_sides * in_sides : many_sides * many_sides;
    }
  }
  sample(proxies);
  is_known_ = count != 0;
  if (is_known_) estimate(sums, static_cast<double>(count));
}

template <class S>
Reach<S> Motion<S>::after(unsigned updates) const {
  Reach<S> reach;
  for (int d = 0; d < 3; ++d) {
    const S distance = is_known_ ? static_cast<S>(updates) * steps_[d] : static_cast<S>(0.125);
    (is_relative_ || !is_known_ ? reach.sides : reach.more)[d] = distance;
  }
  return reach;
}

/// If steps are of one length whatever the sides, small boxes make many sides of them, and the other way round.
template <class S>
void Motion<S>::estimate(const AxisSums (&sums)[3], double count) {
  double absolute = 0, relative = 0;
  for (int d = 0; d < 3; ++d) {
    const double side = sums[d].side / count;
    sides_[d] = static_cast<S>(side);
    if (sums[d].squares != 0) absolute += side > 0 ? std::sqrt(sums[d].squares / count) / side : many_sides;
    relative += std::sqrt(sums[d].in_sides / count);
  }
  is_relative_ = relative <= absolute * 1.01;
  const auto mean_square = [&](const AxisSums& sum) { return (is_relative_ ? sum.in_sides : sum.squares) / count; };
  const double most = std::max({mean_square(sums[0]), mean_square(sums[1]), mean_square(sums[2])});
  for (int d = 0; d < 3; ++d)
    steps_[d] = static_cast<S>(most_to_mean * std::sqrt(std::max(mean_square(sums[d]), most / 1024)));
}

template class Motion<float>;
template class Motion<double>;

}  // namespace boxstream::detail
