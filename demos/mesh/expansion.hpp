// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace boxstream::mesh {

/// A number as the sum of doubles, exact: what rounding takes away from one term is kept in another (J. R. Shewchuk,
/// "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997).
///
/// Exact as long as nothing overflows and no product of two terms underflows. Slow: for what a filter cannot decide.
class Expansion {
 public:
  Expansion() = default;

  /// a - b.
  static Expansion difference(double a, double b);

  friend Expansion operator+(const Expansion& a, const Expansion& b);
  friend Expansion operator-(const Expansion& a, const Expansion& b);
  friend Expansion operator*(const Expansion& a, const Expansion& b);

  /// -1, 0 or 1.
  int sign() const;

 private:
  void add(double term);
  Expansion times(double factor) const;

  /// By increasing magnitude, none zero, and no two have bits of the same weight, so that the last has the sign of all.
  std::vector<double> terms_;
};

}  // namespace boxstream::mesh
