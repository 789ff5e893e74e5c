// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include "mesh/triangle_triangle.hpp"

/// What is true of points and triangles, by constructing in rational numbers what they have in common: another way than
/// the signs of determinants, and nothing is rounded.
namespace boxstream::mesh::tests {

using Rational = boost::multiprecision::cpp_rational;

struct Point {
  Rational x[3];
  friend bool operator==(const Point& a, const Point& b) {
    return a.x[0] == b.x[0] && a.x[1] == b.x[1] && a.x[2] == b.x[2];
  }
};

inline Point exactly(const Vec3& v) {
  return {{Rational(v[0]), Rational(v[1]), Rational(v[2])}};
}
inline Point operator-(const Point& a, const Point& b) {
  return {{a.x[0] - b.x[0], a.x[1] - b.x[1], a.x[2] - b.x[2]}};
}
inline Rational dot(const Point& a, const Point& b) {
  return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}
inline Point cross(const Point& a, const Point& b) {
  return {{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2], a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}
/// a + t (b - a).
inline Point between(const Point& a, const Point& b, const Rational& t) {
  const Point d = b - a;
  return {{a.x[0] + t * d.x[0], a.x[1] + t * d.x[1], a.x[2] + t * d.x[2]}};
}
inline int sign(const Rational& r) {
  return r.sign();
}

/// What the segment from p to q and a triangle share, by its ends: none, one point, or two.
inline std::vector<Point> shared(const Point& p, const Point& q, const Point (&t)[3]) {
  const Point n = cross(t[1] - t[0], t[2] - t[0]);
  Rational from = 0, to = 1;
  // Each side is a half-space: of the plane itself, and of the three planes upright on it through the edges.
  const auto cut = [&](const Point& inward, const Point& on) {
    const Rational a = dot(inward, p - on), slope = dot(inward, q - p);
    if (slope == 0) {
      if (a < 0) from = 2;
    } else if (slope > 0) {
      from = std::max(from, Rational(-a / slope));
    } else {
      to = std::min(to, Rational(-a / slope));
    }
  };
  cut(n, t[0]);
  cut(Point{} - n, t[0]);
  for (int i = 0; i < 3; ++i) cut(cross(n, t[(i + 1) % 3] - t[i]), t[i]);
  if (from > to) return {};
  if (from == to) return {between(p, q, from)};
  return {between(p, q, from), between(p, q, to)};
}

/// Points whose convex hull is what two triangles share.
inline std::vector<Point> shared(const Triangle& s, const Triangle& t) {
  const Point a[3] = {exactly(s[0]), exactly(s[1]), exactly(s[2])},
              b[3] = {exactly(t[0]), exactly(t[1]), exactly(t[2])};
  std::vector<Point> all;
  for (int i = 0; i < 3; ++i) {
    for (const Point& p : shared(a[i], a[(i + 1) % 3], b)) all.push_back(p);
    for (const Point& p : shared(b[i], b[(i + 1) % 3], a)) all.push_back(p);
  }
  return all;
}

inline bool has_area(const Triangle& t) {
  return !(cross(exactly(t[1]) - exactly(t[0]), exactly(t[2]) - exactly(t[0])) == Point{});
}

/// Do triangles that share their first `n` corners share more?
inline bool meet_beyond(int n, const Triangle& s, const Triangle& t) {
  const auto known = [&](const Point& p) {
    if (n == 0) return false;
    const Point u = exactly(s[0]);
    if (n == 1) return p == u;
    const Point v = exactly(s[1]);
    return cross(v - u, p - u) == Point{} && dot(p - u, v - u) >= 0 && dot(p - v, u - v) >= 0;
  };
  const std::vector<Point> all = shared(s, t);
  return !std::all_of(all.begin(), all.end(), known);
}

inline Rational squared_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point e = b - a;
  const Rational all = dot(e, e);
  Rational t = all == 0 ? Rational(0) : Rational(dot(p - a, e) / all);
  t = std::clamp(t, Rational(0), Rational(1));
  const Point d = p - between(a, b, t);
  return dot(d, d);
}

/// The distance of a point to a triangle, squared. It may lack area.
inline Rational squared_distance(const Vec3& point, const Triangle& triangle) {
  const Point p = exactly(point);
  const Point t[3] = {exactly(triangle[0]), exactly(triangle[1]), exactly(triangle[2])};
  const Point n = cross(t[1] - t[0], t[2] - t[0]);
  const Rational n2 = dot(n, n);
  bool over = n2 != 0;
  Rational least = squared_to_segment(p, t[2], t[0]);
  for (int i = 0; i < 3; ++i) {
    if (over && dot(cross(n, t[(i + 1) % 3] - t[i]), p - t[i]) < 0) over = false;
    least = std::min(least, squared_to_segment(p, t[i], t[(i + 1) % 3]));
  }
  if (!over) return least;
  const Rational height = dot(n, p - t[0]);
  return height * height / n2;
}

}  // namespace boxstream::mesh::tests
