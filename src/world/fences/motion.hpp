// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "world/state/proxies.hpp"

namespace boxstream::detail {

/// Distances by side, on each axis.
template <class S>
struct Reach {
  S sides[3] = {};
  S more[3] = {};

  S of(int axis, S side) const { return sides[axis] * side + more[axis]; }
};

/// How far boxes go from one update to the next, by a sample of the proxies, and how far all go together.
///
/// Estimates, on which only costs depend. Everything here needs the default floating-point environment.
template <class S>
class Motion {
 public:
  using Box = BasicAabb<S>;

  /// Takes a sample for the next look to compare with. May throw std::bad_alloc.
  void sample(const ProxyTable<S>& proxies);

  /// Compares the sample, which is of the update before, with what it is now, which it takes. May throw std::bad_alloc.
  void look(const ProxyTable<S>& proxies);

  /// The last look has nothing to compare with any more.
  void forget() noexcept { last_.clear(); }

  /// True if the last look found something to compare with. Else the rest means nothing.
  bool is_known() const { return is_known_; }

  /// True if nearly all boxes went somewhere together.
  bool has_common() const { return is_known_ && (common_[0] != 0 || common_[1] != 0 || common_[2] != 0); }

  /// What nearly all boxes have in common on an axis: how far they went, or 0.
  S common(int axis) const { return common_[axis]; }

  /// How far most boxes get beyond that in so many updates at most; without knowledge, an eighth of their side.
  Reach<S> after(unsigned updates) const;

  /// The mean of the sides.
  S side(int axis) const { return sides_[axis]; }

 private:
  static constexpr std::size_t least_sampled = 16, most_sampled = 256;
  static std::size_t sampled(std::size_t ranks) {
    return std::min(ranks, std::clamp(ranks / 16, least_sampled, most_sampled));
  }

  /// Over the boxes of the sample, on one axis.
  struct AxisSums {
    double went = 0;      // with sign
    double went_any = 0;  // without
    double side = 0;
    double squares = 0;   // of how far each went beyond what all have in common
    double in_sides = 0;  // the same in sides of each box
  };

  void estimate(const AxisSums (&sums)[3], double count);

  std::vector<Box> last_;
  bool is_known_ = false;
  bool is_relative_ = true;  // boxes go in proportion to their sides
  S steps_[3] = {};          // in sides if so
  S sides_[3] = {};
  S common_[3] = {};
};

/// True if the box is valid and of numbers that are not too large to compute with.
template <class S>
bool is_moderate(const BasicAabb<S>& box) {
  constexpr S largest = static_cast<S>(1e18);
  bool moderate = true;
  for (int d = 0; d < 3; ++d)
    moderate = moderate & (-largest < box.min[d]) & (box.min[d] <= box.max[d]) & (box.max[d] < largest);
  return moderate;
}

extern template class Motion<float>;
extern template class Motion<double>;

}  // namespace boxstream::detail
