// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include <boxstream/aabb.hpp>

#include "papers/hybrid/box.hpp"

namespace boxstream::papers {

/// The same boxes twice: half-open integers for the paper's procedures, and closed floats, with the same pairs, for the
/// engine.
struct Input {
  std::vector<Box> boxes;
  std::vector<Aabb> closed;
};

/// How the skewed distributions are read. The paper has their lengths and no low ends. Those of the balanced one, from
/// 1 to n - floor(n^p) with p = 2/3, have no place where p = 1.
enum class LowEnds {
  alike,  ///< all low ends are 1 in a dimension with p = 1
  differ  ///< low ends from 1 to n there
};

/// A distribution by its name among the batches, where those of section 5 are U (balanced), W1 to W6 (the rows of
/// table 1) and S (sphere). The integer boxes [lo, hi) of U and W are the closed boxes [lo, hi - 1]; all others are
/// real and ranked. n < 2^23.
Input make_input(std::string_view batch, std::size_t n, std::uint64_t seed, LowEnds low_ends = LowEnds::alike);

struct BipartiteInput {
  Input a, b;
};
/// n boxes in all, every other one in `a`, so that there are half as many pairs as in the complete case.
BipartiteInput make_bipartite(std::string_view batch, std::size_t n, std::uint64_t seed,
                              LowEnds low_ends = LowEnds::alike);

/// The closed floats for half-open integers of less than 2^24.
std::vector<Aabb> closed(const std::vector<Box>& boxes);

}  // namespace boxstream::papers
