// SPDX-License-Identifier: MIT
#include "polytope.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace boxstream::ccd {

Polytope::Polytope(const ShapePair& pair) : pair_(pair) {
  constexpr std::size_t usual_points = 64;
  points_.reserve(usual_points);
  faces_.reserve(6 * usual_points);
  by_height_.reserve(6 * usual_points);
  stuck_ = !start();
}

void Polytope::add_known(double width, const Vec& direction) {
  if (width < width_) width_ = width, direction_ = direction;
}

/// The point of A - B that is farthest along a direction.
Vec Polytope::support(const Vec& unit) {
  const Translation translation = translation_along(pair_, unit);
  add_known(translation.width, unit);
  translations_.emplace_back(translation.width, unit);
  return translation.point;
}

/// The support point along +unit or -unit, whichever is farther from `from`.
Vec Polytope::farther_of_both(const Vec& unit, const Vec& from) {
  const Vec up = support(unit), down = support(-unit);
  return unit.dot(up - from) > unit.dot(from - down) ? up : down;
}

bool Polytope::start() {
  // If A - B is flatter than this, one of the support calls has found a separating translation within the tolerance.
  const auto is_off = [&](double length) { return length > pair_.tolerance / 8; };
  const auto offset = [&](const Vec& unit, const Vec& p, const Vec& q) { return std::abs(unit.dot(p - q)); };
  const Vec first = support(Vec::UnitX());
  Vec second = support(-Vec::UnitX());
  for (const Vec& axis : {Vec(Vec::UnitY()), Vec(Vec::UnitZ())})
    if (!is_off((second - first).norm())) second = farther_of_both(axis, first);
  if (!is_off((second - first).norm())) return false;
  const Vec across = (second - first).unitOrthogonal();
  const Vec other = across.cross(second - first).normalized();
  Vec third = farther_of_both(across, first);
  if (!is_off(offset(across, third, first))) third = farther_of_both(other, first);
  const Vec square = (second - first).cross(third - first);
  const double length = square.norm();
  if (!is_off(std::max(offset(across, third, first), offset(other, third, first)))) return false;
  const Vec normal = square / length;
  const Vec fourth = farther_of_both(normal, first);
  if (!is_off(offset(normal, fourth, first))) return false;

  points_ = {first, second, third, fourth};
  if (normal.dot(fourth - first) > 0) std::swap(points_[1], points_[2]);
  // Corners of a face are counter-clockwise seen from outside.
  return add_face({0, 1, 2}, {3, 2, 1}) && add_face({0, 2, 3}, {0, 2, 3}) && add_face({2, 1, 3}, {0, 3, 1}) &&
         add_face({1, 0, 3}, {0, 1, 2});
}

/// False if it is too thin to have a plane.
bool Polytope::add_face(const std::array<int, 3>& corner, const std::array<int, 3>& beside) {
  const Vec &p = point(corner[0]), &q = point(corner[1]), &r = point(corner[2]);
  const Vec normal = (q - p).cross(r - p);
  const double length = normal.norm();
  if (!(length > 0)) return false;
  const Vec unit = normal / length;
  const double height = std::min({unit.dot(p), unit.dot(q), unit.dot(r)});
  by_height_.emplace_back(height, static_cast<int>(faces_.size()));
  std::push_heap(by_height_.begin(), by_height_.end(), std::greater<>());
  faces_.push_back({corner, beside, unit, height, false});
  return true;
}

/// Marks the faces visible from the point, starting from one of them, and lists the edges of the horizon.
bool Polytope::find_horizon(const Vec& point, int from) {
  seen_.assign(1, from);
  horizon_.clear();
  face(from).removed = true;
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Face& at = face(seen_[i]);
    for (std::size_t e = 0; e < 3; ++e) {
      Face& next = face(at.beside[e]);
      if (next.removed) continue;
      if (next.normal.dot(point) - next.height > 4 * pair_.noise) {
        next.removed = true;
        seen_.push_back(at.beside[e]);
      } else {
        horizon_.push_back({at.corner[e], at.corner[(e + 1) % 3], at.beside[e]});
      }
    }
  }
  return order_horizon();
}

/// Orders the edges of the horizon into a ring. False if they are not a single ring, which rounding can cause.
bool Polytope::order_horizon() {
  for (std::size_t i = 0; i + 1 < horizon_.size(); ++i) {
    const auto next = std::find_if(horizon_.begin() + static_cast<std::ptrdiff_t>(i) + 1, horizon_.end(),
                                   [&](const Edge& edge) { return edge.from == horizon_[i].to; });
    if (next == horizon_.end()) return false;
    std::swap(*next, horizon_[i + 1]);
  }
  return horizon_.size() > 2 && horizon_.back().to == horizon_.front().from;
}

/// Replaces the visible faces by a cone from the point to the horizon.
bool Polytope::add(const Vec& point, int above) {
  if (!find_horizon(point, above)) return false;
  const int apex = static_cast<int>(points_.size());
  points_.push_back(point);
  const int first = static_cast<int>(faces_.size()), count = static_cast<int>(horizon_.size());
  for (int i = 0; i < count; ++i) {
    const Edge& edge = horizon_[static_cast<std::size_t>(i)];
    const int next = first + (i + 1) % count, before = first + (i + count - 1) % count;
    if (!add_face({edge.from, edge.to, apex}, {edge.beyond, next, before})) return false;
    for (std::size_t e = 0; e < 3; ++e)
      if (face(edge.beyond).corner[e] == edge.to) face(edge.beyond).beside[e] = first + i;
  }
  return true;
}

/// The face nearest to the origin, or farthest behind it.
int Polytope::lowest() {
  while (face(by_height_.front().second).removed) {
    std::pop_heap(by_height_.begin(), by_height_.end(), std::greater<>());
    by_height_.pop_back();
  }
  return by_height_.front().second;
}

void Polytope::grow(int most_points) {
  while (!stuck_) {
    const int index = lowest();
    const Face& low = face(index);
    // The polytope grows, so its lowest face rises, except for rounding.
    if (low.height < least_ - pair_.tolerance) {
      stuck_ = true;
      return;
    }
    if (low.height >= 0) least_ = std::max(least_, low.height);
    if (width_ - least_ <= pair_.tolerance) return;
    if (static_cast<int>(points_.size()) >= most_points) {
      limit_ = true;
      return;
    }
    const Vec point = support(low.normal);
    // The face is on the boundary of A - B already.
    if (low.normal.dot(point) - low.height <= pair_.tolerance / 32)
      stuck_ = true;
    else
      stuck_ = !add(point, index);
  }
}

}  // namespace boxstream::ccd
