// SPDX-License-Identifier: MIT
#include "papers/volumes/dop.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

#include "papers/volumes/axis_box.hpp"
#include "papers/volumes/volume.hpp"

namespace boxstream::papers::volumes {

namespace {

/// { p : normal p <= offset }; the normal has any length but 0.
struct HalfSpace {
  Point normal;
  double offset;
};

struct Size {
  double area, volume;
};

using Polygon = std::vector<Point>;

/// The part of a convex polygon in the half-space.
Polygon cut(const Polygon& polygon, const HalfSpace& half_space) {
  Polygon left;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
    const double a = half_space.normal.dot(from) - half_space.offset, b = half_space.normal.dot(to) - half_space.offset;
    if (a <= 0) left.push_back(from);
    if ((a < 0 && b > 0) || (a > 0 && b < 0)) left.push_back(from + (to - from) * (a / (a - b)));
  }
  return left;
}

double area_of(const Polygon& polygon) {
  Point twice = Point::Zero();
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return twice.norm() / 2;
}

/// Of the polytope that is the intersection: each plane's face is a square, cut down by all other half-spaces.
/// The polytope must lie within `radius` of `near`, a point inside it or not; no two half-spaces may be the same.
Size size_of(Span<const HalfSpace> half_spaces, const Point& near, double radius) {
  Size size{0, 0};
  for (std::size_t i = 0; i < half_spaces.size(); ++i) {
    const Point normal = half_spaces[i].normal.normalized();
    const double height = half_spaces[i].offset / half_spaces[i].normal.norm() - normal.dot(near);
    const Point middle = near + height * normal;
    const Point u = normal.unitOrthogonal() * (2 * radius), v = normal.cross(u);
    Polygon face{middle - u - v, middle + u - v, middle + u + v, middle - u + v};
    for (std::size_t j = 0; j < half_spaces.size(); ++j)
      if (j != i) face = cut(face, half_spaces[j]);
    const double area = area_of(face);
    size.area += area;
    size.volume += area * height / 3;  // of the cone from `near`; below 0 where it is outside
  }
  return size;
}

constexpr double normals[13][3] = {
    {1, 0, 0}, {0, 1, 0},  {0, 0, 1},                                      // of the faces of a cube
    {1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1},                         // its corners
    {1, 1, 0}, {1, -1, 0}, {1, 0, 1},  {1, 0, -1}, {0, 1, 1}, {0, 1, -1},  // and its edges
};

template <int K>
Size size_of_dop(const Dop<K>& dop) {
  std::vector<HalfSpace> half_spaces;
  for (std::size_t i = 0; i < Dop<K>::slabs; ++i) {
    half_spaces.push_back({Dop<K>::normal(i), dop.high[i]});
    half_spaces.push_back({-Dop<K>::normal(i), -dop.low[i]});
  }
  const AxisBox box{dop.bounds()};
  const double diagonal = (Point(box.box.max) - Point(box.box.min)).norm();
  return size_of(half_spaces, box.centre(), diagonal);
}

}  // namespace

template <int K>
Point Dop<K>::normal(std::size_t slab) {
  const std::size_t skipped = K == 18 && slab >= 3 ? 4 : 0;
  return Point(normals[slab + skipped]);
}

template <int K>
Dop<K> Dop<K>::around(Points points) {
  Dop dop;
  for (std::size_t i = 0; i < slabs; ++i) {
    const Point n = normal(i);
    dop.low[i] = std::numeric_limits<double>::infinity();
    dop.high[i] = -dop.low[i];
    for (const Point& p : points) {
      // A coordinate is what it is; sums are rounded.
      const double along = n.dot(p), error = i < 3 ? 0 : slack * p.lpNorm<1>();
      dop.low[i] = std::min(dop.low[i], along - error);
      dop.high[i] = std::max(dop.high[i], along + error);
    }
  }
  return dop;
}

template <int K>
Dop<K> Dop<K>::around(Span<const Dop> dops) {
  Dop all = dops[0];
  for (const Dop& dop : dops)
    for (std::size_t i = 0; i < slabs; ++i) {
      all.low[i] = std::min(all.low[i], dop.low[i]);
      all.high[i] = std::max(all.high[i], dop.high[i]);
    }
  return all;
}

template <int K>
double Dop<K>::excess(const Point& p) const {
  double excess = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < slabs; ++i) {
    const Point n = normal(i);
    const double along = n.dot(p);
    excess = std::max(excess, std::max(along - high[i], low[i] - along) / (n.norm() * (1 + slack)));
  }
  return excess;
}

template <int K>
double Dop<K>::volume() const {
  return size_of_dop(*this).volume;
}

template <int K>
double Dop<K>::area() const {
  return size_of_dop(*this).area;
}

template struct Dop<14>;
template struct Dop<18>;
template struct Dop<26>;

}  // namespace boxstream::papers::volumes
