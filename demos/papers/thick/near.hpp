// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/near.hpp>

#include "papers/thick/report_intersections.hpp"

namespace boxstream::papers {

/// Fixed-radius near neighbours, the paper's instance of the algorithm: what `boxstream::find_near_pairs` finds, for
/// points, disks (D = 2: z is 0, or the same for all) and balls (D = 3). `found(i, j)`, i < j, for each pair once.
///
/// The objects are the balls, each grown by half of `distance`. Their centres are the reference points, which cannot
/// differ by more than the largest diameter. The predicate is `is_near`, of degree two and exact; the algorithm adds
/// comparisons of coordinates only, so all of it is.
/// Errors: std::invalid_argument for an invalid ball, and for a distance that is not finite and >= 0.
template <std::size_t D, class S, class Found>
void thick_near_pairs(Span<const BasicBall<S>> balls, S distance, Found&& found, Pivot pivot = Pivot::median) {
  if (!(std::isfinite(distance) && distance >= 0)) throw std::invalid_argument("a distance must be finite and >= 0");
  S largest = 0;
  for (const BasicBall<S>& ball : balls) {
    if (!(std::isfinite(ball.radius) && ball.radius >= 0))
      throw std::invalid_argument("a radius is not finite and >= 0");
    largest = std::max(largest, ball.radius);
  }
  // Two roundings, and half a ulp is made up for by more than one.
  constexpr S more = 1 + 4 * std::numeric_limits<S>::epsilon();
  const S reach = (2 * largest + distance) * more + std::numeric_limits<S>::denorm_min();
  report_within_reach<D>(
      balls, reach, [](const BasicBall<S>& ball, std::size_t d) { return ball.centre[d]; },
      [distance](const BasicBall<S>& a, const BasicBall<S>& b) { return is_near(a, b, distance); }, found, pivot);
}

}  // namespace boxstream::papers
