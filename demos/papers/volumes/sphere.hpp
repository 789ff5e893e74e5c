// SPDX-License-Identifier: MIT
#pragma once

#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

/// A bounding sphere: four numbers, the cheapest test, and the same however its content turns. Not always the smallest
/// one, but the smaller of two: about the middle of the content's box, which is the smallest around a box; and what two
/// points that are far apart along an axis become when it grows for each point left outside (Ritter).
struct Sphere {
  Point centre;
  double radius;

  static Sphere around(Points points);
  static Sphere around(Span<const Sphere> spheres);
  static constexpr bool merges_exactly = false;
  static std::string name() { return "sphere"; }

  double excess(const Point& p) const { return (p - centre).norm() - radius; }
  Aabb64 bounds() const;
  double volume() const;
  double area() const;

  friend bool overlap(const Sphere& a, const Sphere& b) {
    const double reach = (a.radius + b.radius) * (1 + slack);
    return (b.centre - a.centre).squaredNorm() <= reach * reach * (1 + slack);
  }
};
static_assert(Volume<Sphere>);

}  // namespace boxstream::papers::volumes
