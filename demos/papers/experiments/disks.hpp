// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <boxstream/near.hpp>

#include "papers/experiments/measure.hpp"

namespace boxstream::papers {

/// Disks (all z are 0) or balls, uniform in the unit square or cube, in single precision as in the paper. Their radii
/// differ by a factor of at most `factor`, their logarithms uniform, and are such that about `pairs` of them intersect.
std::vector<Ball> make_balls(std::size_t n, int dimensions, double pairs, double factor, std::uint64_t seed);

/// The algorithm for thick objects; the engine, warm; all pairs. They refer to `balls`.
Contestant thick(const std::vector<Ball>& balls, int dimensions, float distance = 0);
Contestant thick_at_random(const std::vector<Ball>& balls, int dimensions);
Contestant engine(const std::vector<Ball>& balls, float distance = 0);
Contestant naive(const std::vector<Ball>& balls);

}  // namespace boxstream::papers
