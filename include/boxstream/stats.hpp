// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>

namespace boxstream {

/// What one search did. Counts do not depend on threads or on the SIMD width.
struct Stats {
  std::uint64_t boxes = 0;        ///< boxes given, both sets together
  std::uint64_t invalid = 0;      ///< of these, boxes with a NaN or min > max, which pair with nothing
  std::uint64_t pairs = 0;        ///< pairs delivered to the caller
  std::uint64_t nodes = 0;        ///< nodes of the streamed tree that were split
  std::uint64_t cells = 0;        ///< leaves that were swept
  std::uint64_t records = 0;      ///< boxes swept in all leaves, copies included
  std::uint64_t tests = 0;        ///< box against box comparisons in the sweeps
  std::uint64_t over_budget = 0;  ///< sweeps that compared too much, whose rest the tree with exact medians did
};

}  // namespace boxstream
