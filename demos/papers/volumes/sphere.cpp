// SPDX-License-Identifier: MIT
#include "papers/volumes/sphere.hpp"

#include <algorithm>
#include <numbers>

namespace boxstream::papers::volumes {

namespace {

Sphere as_sphere(const Sphere& sphere) {
  return sphere;
}
Sphere as_sphere(const Point& point) {
  return {point, 0};
}

/// The smallest sphere around two.
Sphere merged(const Sphere& a, const Sphere& b) {
  const Point way = b.centre - a.centre;
  const double distance = way.norm();
  if (distance + b.radius <= a.radius) return a;
  if (distance + a.radius <= b.radius) return b;
  const double radius = (distance + a.radius + b.radius) / 2;
  return {a.centre + way * ((radius - a.radius) / distance), radius};
}

/// Two that are far apart, on the axis along which all are widest.
template <class Element>
Sphere around_widest(Span<const Element> elements) {
  const auto centre = [&](std::size_t i) { return as_sphere(elements[i]).centre; };
  std::size_t from = 0, to = 0;
  double widest = 0;
  for (int d = 0; d < 3; ++d) {
    std::size_t low = 0, high = 0;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      if (centre(i)[d] < centre(low)[d]) low = i;
      if (centre(i)[d] > centre(high)[d]) high = i;
    }
    const double width = centre(high)[d] - centre(low)[d];
    if (width <= widest) continue;
    widest = width;
    from = low;
    to = high;
  }
  return merged(as_sphere(elements[from]), as_sphere(elements[to]));
}

template <class Element>
Point middle_of(Span<const Element> elements) {
  Point low = as_sphere(elements[0]).centre, high = low;
  for (const Element& element : elements) {
    const Sphere inner = as_sphere(element);
    low = low.cwiseMin(inner.centre - Point::Constant(inner.radius));
    high = high.cwiseMax(inner.centre + Point::Constant(inner.radius));
  }
  return (low + high) / 2;
}

/// Wherever rounding has put the centre: the radius counts from there, and is rounded up once.
template <class Element>
Sphere around_from(const Point& centre, Span<const Element> elements) {
  double radius = 0;
  for (const Element& element : elements) {
    const Sphere inner = as_sphere(element);
    radius = std::max(radius, (inner.centre - centre).norm() + inner.radius);
  }
  return {centre, radius * (1 + slack)};
}

template <class Element>
Sphere around_all(Span<const Element> elements) {
  Sphere grown = around_widest(elements);
  for (const Element& element : elements) grown = merged(grown, as_sphere(element));
  grown = around_from(grown.centre, elements);
  const Sphere central = around_from(middle_of(elements), elements);
  return central.radius <= grown.radius ? central : grown;
}

}  // namespace

Sphere Sphere::around(Points points) {
  return around_all(points);
}

Sphere Sphere::around(Span<const Sphere> spheres) {
  return around_all(spheres);
}

Aabb64 Sphere::bounds() const {
  Aabb64 box{};
  for (int d = 0; d < 3; ++d) {
    const double reach = radius + slack * (radius + std::abs(centre[d]));
    box.min[d] = centre[d] - reach;
    box.max[d] = centre[d] + reach;
  }
  return box;
}

double Sphere::volume() const {
  return 4.0 / 3.0 * std::numbers::pi * radius * radius * radius;
}

double Sphere::area() const {
  return 4 * std::numbers::pi * radius * radius;
}

}  // namespace boxstream::papers::volumes
