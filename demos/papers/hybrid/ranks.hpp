// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/span.hpp>

#include "papers/hybrid/box.hpp"

namespace boxstream::papers {

/// Closed boxes of real numbers as half-open boxes of integers that intersect exactly when those touch or overlap.
///
/// "We map the floating point numbers to their ranks in the respective sorted orders" (section 2): of all ends on an
/// axis, each takes its place in their order. Among equal ends the low ones come first, which is what turns closed into
/// half-open: lo_a <= hi_b becomes rank < rank even when the two are equal, and a box without extent keeps one place
/// between its ends. No two ends have the same rank: general position comes for free.
///
/// At most 2^30 - 1 boxes in all. Throws std::invalid_argument for a box with a NaN or with min > max.
std::vector<Box> ranks(Span<const Aabb> boxes);
std::vector<Box> ranks(Span<const Aabb64> boxes);

struct TwoSets {
  std::vector<Box> a, b;
};
/// Two sets on common ranks.
TwoSets ranks(Span<const Aabb> a, Span<const Aabb> b);
TwoSets ranks(Span<const Aabb64> a, Span<const Aabb64> b);

}  // namespace boxstream::papers
