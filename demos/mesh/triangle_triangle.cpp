// SPDX-License-Identifier: MIT
#include "mesh/triangle_triangle.hpp"

#include <algorithm>

namespace boxstream::mesh {
namespace {

using Signs = std::array<int, 3>;

bool all_on_one_side(const Signs& s) {
  return s[0] != 0 && s[0] == s[1] && s[1] == s[2];
}

/// Sides of the plane of `t` that the corners of `s` are on.
Signs sides(const Triangle& t, const Triangle& s) {
  return {orientation(t[0], t[1], t[2], s[0]), orientation(t[0], t[1], t[2], s[1]),
          orientation(t[0], t[1], t[2], s[2])};
}

// ---- within one plane: seen along an axis that is not in it, which keeps what meets and what does not

Vec2 without(std::size_t axis, const Vec3& p) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

struct Flat {
  std::array<Vec2, 3> corners;
  int turn;
};

Flat seen_along(std::size_t axis, const Triangle& t) {
  const std::array<Vec2, 3> c{without(axis, t[0]), without(axis, t[1]), without(axis, t[2])};
  return {c, orientation(c[0], c[1], c[2])};
}

/// An axis along which the triangle is not seen as a line; 3 if it is one.
std::size_t axis_to_look_along(const Triangle& t) {
  std::size_t axis = 0;
  while (axis < 3 && seen_along(axis, t).turn == 0) ++axis;
  return axis;
}

bool contains(const Flat& t, const Vec2& p) {
  for (std::size_t i = 0; i < 3; ++i)
    if (orientation(t.corners[i], t.corners[(i + 1) % 3], p) == -t.turn) return false;
  return true;
}

bool segments_meet(const Vec2& p, const Vec2& q, const Vec2& r, const Vec2& s) {
  const int sides_of_pq[] = {orientation(p, q, r), orientation(p, q, s)};
  const int sides_of_rs[] = {orientation(r, s, p), orientation(r, s, q)};
  if (sides_of_pq[0] * sides_of_pq[1] > 0 || sides_of_rs[0] * sides_of_rs[1] > 0) return false;
  if (sides_of_pq[0] != 0 || sides_of_pq[1] != 0) return true;
  for (std::size_t d = 0; d < 2; ++d)  // on one line
    if (std::max(p[d], q[d]) < std::min(r[d], s[d]) || std::max(r[d], s[d]) < std::min(p[d], q[d])) return false;
  return true;
}

bool segment_meets(const Vec2& p, const Vec2& q, const Flat& t) {
  for (std::size_t i = 0; i < 3; ++i)
    if (segments_meet(p, q, t.corners[i], t.corners[(i + 1) % 3])) return true;
  return contains(t, p);
}

bool meet_in_plane(const Triangle& s, const Triangle& t) {
  const std::size_t axis = axis_to_look_along(t);
  const Flat a = seen_along(axis, s), b = seen_along(axis, t);
  for (std::size_t i = 0; i < 3; ++i)
    if (segment_meets(a.corners[i], a.corners[(i + 1) % 3], b)) return true;
  return contains(a, b.corners[0]);
}

// ---- in space

/// `side_p` and `side_q` are the sides of the plane of `t` that p and q are on.
bool segment_meets(const Vec3& p, const Vec3& q, int side_p, int side_q, const Triangle& t) {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    const std::size_t axis = axis_to_look_along(t);
    return segment_meets(without(axis, p), without(axis, q), seen_along(axis, t));
  }
  // It crosses the plane in one point, which is in the triangle unless the line passes it on different sides.
  const Signs s{orientation(p, q, t[0], t[1]), orientation(p, q, t[1], t[2]), orientation(p, q, t[2], t[0])};
  const auto [least, most] = std::minmax({s[0], s[1], s[2]});
  return least == most || least == 0 || most == 0;
}

bool some_edge_meets(const Triangle& s, const Signs& sides, const Triangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (segment_meets(s[i], s[j], sides[i], sides[j], t)) return true;
  }
  return false;
}

}  // namespace

bool has_area(const Triangle& t) {
  return axis_to_look_along(t) < 3;
}

bool meet(const Triangle& s, const Triangle& t) {
  const Signs of_s = sides(t, s);
  if (all_on_one_side(of_s)) return false;
  if (of_s == Signs{0, 0, 0}) return meet_in_plane(s, t);
  const Signs of_t = sides(s, t);
  if (all_on_one_side(of_t)) return false;
  return some_edge_meets(s, of_s, t) || some_edge_meets(t, of_t, s);
}

// What they share is convex, so another common point means a segment from the corner on. It goes on to where the ray
// along it leaves the first of the two, and rays from a corner leave a triangle through the edge that faces it.
bool meet_beyond_corner(const Triangle& s, const Triangle& t) {
  const auto side = [](const Triangle& of, const Vec3& p) { return orientation(of[0], of[1], of[2], p); };
  const int s1 = side(t, s[1]), s2 = side(t, s[2]);
  if (s1 * s2 > 0) return false;  // s touches the plane of t in the corner only
  const int t1 = side(s, t[1]), t2 = side(s, t[2]);
  if (t1 * t2 > 0) return false;
  return segment_meets(s[1], s[2], s1, s2, t) || segment_meets(t[1], t[2], t1, t2, s);
}

bool meet_beyond_edge(const Triangle& s, const Triangle& t) {
  if (orientation(s[0], s[1], s[2], t[2]) != 0) return false;
  const std::size_t axis = axis_to_look_along(s);
  return seen_along(axis, s).turn == seen_along(axis, t).turn;
}

}  // namespace boxstream::mesh
