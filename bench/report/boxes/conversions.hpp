// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/aabb.hpp>

namespace boxstream::report {

/// Each bound to the nearest float. Two boxes that overlap still do, because rounding never swaps the order of two
/// numbers; but the box may no longer contain all of what it was.
Aabb nearest_floats(const Aabb64& box);

/// The smallest box of floats that contains `box`, in any rounding mode.
Aabb outward_floats(const Aabb64& box);

/// True when no point of `inner` is outside `outer`.
bool contains(const Aabb& outer, const Aabb64& inner);

/// Bounds on 2^16 places along each axis of a world, as a sweep over 16-bit integers has them: minima on even places,
/// maxima on odd ones.
class Lattice16 {
 public:
  /// `world` has sides.
  explicit Lattice16(const Aabb64& world);

  /// The box of all cells that `box` reaches into, in the coordinates of the world. What is outside the world stays as
  /// it is.
  Aabb outward(const Aabb& box) const;

  /// Sides of a cell.
  const double* cell() const { return cell_; }

 private:
  double low_[3], cell_[3];
};

/// The cube with the centre and the longest side of `box`, rounded outward; it contains the box.
Aabb cube_around(const Aabb& box);

}  // namespace boxstream::report
