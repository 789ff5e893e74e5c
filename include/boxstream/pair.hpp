// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <cstdint>

namespace boxstream {

/// Indices of two boxes that overlap. In one set: a < b. In two sets: `a` indexes the first, `b` the second.
struct Pair {
  std::uint32_t a;
  std::uint32_t b;

  friend constexpr bool operator==(Pair x, Pair y) { return x.a == y.a && x.b == y.b; }
  friend constexpr bool operator!=(Pair x, Pair y) { return !(x == y); }
  /// By `a`, then by `b`.
  friend constexpr bool operator<(Pair x, Pair y) { return x.a != y.a ? x.a < y.a : x.b < y.b; }
};

}  // namespace boxstream
