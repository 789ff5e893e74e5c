// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

inline double area(const Aabb64& box) {
  const double x = box.max[0] - box.min[0], y = box.max[1] - box.min[1], z = box.max[2] - box.min[2];
  return 2 * (x * y + y * z + z * x);
}

inline double volume(const Aabb64& box) {
  return (box.max[0] - box.min[0]) * (box.max[1] - box.min[1]) * (box.max[2] - box.min[2]);
}

/// An axis-aligned bounding box: six numbers. Exact, and its merge is as tight as a new one around all points; but it
/// cannot turn with what it encloses.
struct AxisBox {
  Aabb64 box;

  static AxisBox around(Points points);
  static AxisBox around(Span<const AxisBox> boxes);
  static constexpr bool merges_exactly = true;
  static std::string name() { return "AABB"; }

  Point centre() const;
  double excess(const Point& p) const;
  Aabb64 bounds() const { return box; }
  double volume() const { return volumes::volume(box); }
  double area() const { return volumes::area(box); }

  friend bool overlap(const AxisBox& a, const AxisBox& b) { return overlaps(a.box, b.box); }
};
static_assert(Volume<AxisBox>);

}  // namespace boxstream::papers::volumes
