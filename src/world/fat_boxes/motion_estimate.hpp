// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/thresholds.hpp"
#include "world/state/proxies.hpp"

namespace boxstream::detail {

/// A length on each axis: a share of the side plus a constant.
template <class S>
struct Margins {
  S sides[3] = {};
  S more[3] = {};

  S of(int axis, S side) const { return sides[axis] * side + more[axis]; }
};

/// Estimates how far boxes move from one update to the next, and how far they all move together, from a sample of the
/// proxies. Margins of fat boxes follow from it.
///
/// Only costs depend on these estimates. Everything here needs the default floating-point environment.
template <class S>
class MotionEstimate {
 public:
  using Box = BasicAabb<S>;

  /// Takes the sample that the next `measure` compares with. May throw std::bad_alloc.
  void sample(const ProxyTable<S>& proxies);

  /// Compares the sample of the previous update with the boxes now, and takes a new sample. May throw std::bad_alloc.
  void measure(const ProxyTable<S>& proxies);

  /// Drops the sample.
  void forget() noexcept { last_.clear(); }

  /// True if the last `measure` had a sample to compare with. Otherwise the values below mean nothing.
  bool is_known() const { return is_known_; }

  /// True if nearly all boxes moved the same way.
  bool has_common_step() const { return is_known_ && (common_[0] != 0 || common_[1] != 0 || common_[2] != 0); }

  /// The mean step on an axis if nearly all boxes moved the same way, else 0.
  S common_step(int axis) const { return common_[axis]; }

  /// Upper bound for most boxes on the distance moved in `updates` updates, beyond the common step. An eighth of the
  /// side if nothing is known.
  Margins<S> after(unsigned updates) const;

  /// The mean of the sides.
  S side(int axis) const { return sides_[axis]; }

 private:
  static std::size_t sampled(std::size_t ranks) {
    return std::min(ranks, std::clamp(ranks / 16, thresholds.least_sampled, thresholds.most_sampled));
  }

  /// Over the boxes of the sample, on one axis.
  struct AxisSums {
    double signed_sum = 0;    // of steps
    double absolute_sum = 0;  // of lengths of steps
    double side = 0;
    double length = 0;    // the usual one of steps beyond the common one
    double in_sides = 0;  // the same, in units of the side of each box
  };

  void estimate(const AxisSums (&sums)[3], double count);

  std::vector<Box> last_;
  std::vector<S> lengths_, in_sides_;  // scratch
  bool is_known_ = false;
  bool is_relative_ = true;  // steps are proportional to sides
  S steps_[3] = {};          // in units of the side if so
  S sides_[3] = {};
  S common_[3] = {};
};

/// True if the box is valid and its coordinates are small enough to compute with.
template <class S>
bool is_moderate(const BasicAabb<S>& box) {
  constexpr S largest = static_cast<S>(1e18);
  bool moderate = true;
  for (int d = 0; d < 3; ++d)
    moderate = moderate & (-largest < box.min[d]) & (box.min[d] <= box.max[d]) & (box.max[d] < largest);
  return moderate;
}

extern template class MotionEstimate<float>;
extern template class MotionEstimate<double>;

}  // namespace boxstream::detail
