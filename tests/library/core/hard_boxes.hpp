// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "batch/cuts/plan.hpp"
#include "inputs/hard.hpp"
#include "oracle.hpp"
#include "random.hpp"

/// Hard families as boxes of either scalar, and what tests add to them.
namespace boxstream::tests {

/// Rounding to S keeps lo <= hi.
template <class S>
Boxes<S> rounded_to(const std::vector<Aabb64>& exact) {
  Boxes<S> boxes(exact.size());
  for (std::size_t i = 0; i < exact.size(); ++i)
    for (int d = 0; d < 3; ++d) {
      boxes[i].min[d] = static_cast<S>(exact[i].min[d]);
      boxes[i].max[d] = static_cast<S>(exact[i].max[d]);
    }
  return boxes;
}

/// n boxes, or as many as the family takes.
template <class S>
Boxes<S> hard_boxes(const batches::HardFamily& family, std::size_t n, std::uint64_t seed) {
  batches::Random random(seed);
  return rounded_to<S>(family.make(std::min(n, family.largest), random));
}

/// Each end where it is, or the next number of S on either side: ends that coincided do so no more.
template <class S>
void move_by_one_step(Boxes<S>& boxes, std::uint64_t seed) {
  constexpr S inf = std::numeric_limits<S>::infinity();
  Random random(seed);
  for (auto& box : boxes)
    for (int d = 0; d < 3; ++d) {
      const S lo = std::nextafter(box.min[d], random.chance(0.5) ? -inf : inf);
      const S hi = std::nextafter(box.max[d], random.chance(0.5) ? -inf : inf);
      box.min[d] = std::min(lo, hi);
      box.max[d] = std::max(lo, hi);
    }
}

/// Every other box, from `first` on.
template <class S>
Boxes<S> every_other(const Boxes<S>& boxes, std::size_t first) {
  Boxes<S> some;
  for (std::size_t i = first; i < boxes.size(); i += 2) some.push_back(boxes[i]);
  return some;
}

/// Which places of n boxes the sample of the root looks at.
inline std::vector<bool> sampled_places(std::size_t n) {
  struct Spy {
    std::vector<bool>& seen;
    std::size_t size() const { return seen.size(); }
    bool valid(std::size_t i) const {
      seen[i] = true;
      return false;
    }
    detail::Record operator[](std::size_t) const { return {}; }
  };
  std::vector<bool> seen(n);
  detail::Arena arena;
  detail::Sample sample(arena);
  sample.draw(Spy{seen}, detail::Sample::wanted(n));
  return seen;
}

/// Of two sets of n boxes: those of `shown` where the sample of the root looks, those of `hidden` elsewhere.
template <class S>
Boxes<S> misleading(const Boxes<S>& shown, const Boxes<S>& hidden) {
  const std::vector<bool> seen = sampled_places(hidden.size());
  Boxes<S> boxes = hidden;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (seen[i]) boxes[i] = shown[i];
  return boxes;
}

/// Comparisons and boxes taken into leaves, in terms of n log2(n)^3 + k.
inline double work_by_bound(const Stats& stats) {
  const double n = static_cast<double>(stats.boxes), log = std::log2(n);
  return static_cast<double>(stats.tests + stats.records) / (n * log * log * log + static_cast<double>(stats.pairs));
}

}  // namespace boxstream::tests
