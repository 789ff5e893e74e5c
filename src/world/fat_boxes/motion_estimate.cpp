// SPDX-License-Identifier: MIT
#include "world/fat_boxes/motion_estimate.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::detail {

namespace {

// Of the steps of the sample on an axis, an eighth is longer than the one that counts: what a few boxes do that fall
// while the others tremble is not for all. Those leave their fat boxes, and get wider ones.
constexpr std::size_t longer = 8;

// Ratio of the largest step to that one, for steps spread evenly between zero and the largest; rounded up.
constexpr double most_to_usual = 1.2;

// Steps are capped at this many sides.
constexpr double many_sides = 1000;

}  // namespace

/// The usual step: see `longer`. Reorders them.
template <class S>
static double usual(std::vector<S>& steps) {
  const auto at = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() - 1 - steps.size() / longer);
  std::nth_element(steps.begin(), at, steps.end());
  return static_cast<double>(*at);
}

template <class S>
void MotionEstimate<S>::sample(const ProxyTable<S>& proxies) {
  last_.resize(sampled(proxies.ranks()));
  const std::size_t stride = proxies.ranks() / std::max<std::size_t>(last_.size(), 1);
  for (std::size_t i = 0; i < last_.size(); ++i) last_[i] = proxies.box(static_cast<std::uint32_t>(i * stride));
}

template <class S>
void MotionEstimate<S>::measure(const ProxyTable<S>& proxies) {
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
      const double step = static_cast<double>(to.min[d]) - static_cast<double>(from.min[d]);
      sums[d].signed_sum += step;
      sums[d].absolute_sum += std::abs(step);
      sums[d].side += static_cast<double>(to.max[d]) - static_cast<double>(to.min[d]);
    }
  }
  for (int d = 0; d < 3; ++d) {
    const bool is_shared = count != 0 && 2 * std::abs(sums[d].signed_sum) > sums[d].absolute_sum;
    common_[d] = is_shared ? static_cast<S>(sums[d].signed_sum / static_cast<double>(count)) : S{0};
  }
  for (int d = 0; d < 3 && count != 0; ++d) {
    lengths_.clear();
    in_sides_.clear();
    for (std::size_t i = 0; i < samples; ++i) {
      const Box from = last_[i], to = at(i);
      if (!is_moderate(from) || !is_moderate(to)) continue;
      const S beyond = std::abs(to.min[d] - from.min[d] - common_[d]), side = to.max[d] - to.min[d];
      lengths_.push_back(beyond);
      in_sides_.push_back(beyond < static_cast<S>(many_sides) * side ? beyond / side
                                                                     : static_cast<S>(beyond == 0 ? 0 : many_sides));
    }
    sums[d].length = usual(lengths_);
    sums[d].in_sides = usual(in_sides_);
  }
  sample(proxies);
  is_known_ = count != 0;
  if (is_known_) estimate(sums, static_cast<double>(count));
}

template <class S>
Margins<S> MotionEstimate<S>::after(unsigned updates) const {
  Margins<S> margins;
  for (int d = 0; d < 3; ++d) {
    const S distance = is_known_ ? static_cast<S>(updates) * steps_[d] : static_cast<S>(0.125);
    (is_relative_ || !is_known_ ? margins.sides : margins.more)[d] = distance;
  }
  return margins;
}

/// Steps are taken as absolute lengths or as multiples of the sides, whichever varies less between boxes.
template <class S>
void MotionEstimate<S>::estimate(const AxisSums (&sums)[3], double count) {
  double absolute = 0, relative = 0;
  for (int d = 0; d < 3; ++d) {
    const double side = sums[d].side / count;
    sides_[d] = static_cast<S>(side);
    if (sums[d].length != 0) absolute += side > 0 ? sums[d].length / side : many_sides;
    relative += sums[d].in_sides;
  }
  is_relative_ = relative <= absolute * 1.01;
  const auto step = [&](const AxisSums& sum) { return is_relative_ ? sum.in_sides : sum.length; };
  const double most = std::max({step(sums[0]), step(sums[1]), step(sums[2])});
  for (int d = 0; d < 3; ++d) steps_[d] = static_cast<S>(most_to_usual * std::max(step(sums[d]), most / 32));
}

template class MotionEstimate<float>;
template class MotionEstimate<double>;

}  // namespace boxstream::detail
