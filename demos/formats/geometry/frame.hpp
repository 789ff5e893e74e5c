// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "formats/scene_model/values.hpp"

namespace boxstream::geometry {

using scenes::Quat;
using scenes::times;
using scenes::Vec3;

inline Vec3 plus(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline bool is_finite(const Vec3& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]);
}

/// `v` turned by the unit quaternion `q`.
inline Vec3 turned(const Quat& q, const Vec3& v) {
  const Vec3 u{q[0], q[1], q[2]};
  const Vec3 t = times(cross(u, v), 2);
  return plus(v, plus(times(t, q[3]), cross(u, t)));
}

/// First `b`, then `a`.
inline Quat product(const Quat& a, const Quat& b) {
  const Vec3 u{a[0], a[1], a[2]}, v{b[0], b[1], b[2]};
  const Vec3 w = plus(cross(u, v), plus(times(v, a[3]), times(u, b[3])));
  return {w[0], w[1], w[2], a[3] * b[3] - dot(u, v)};
}

/// A rigid motion: turns, then moves.
struct Frame {
  Vec3 origin{};
  Quat turn{0, 0, 0, 1};

  Vec3 place(const Vec3& point) const { return plus(origin, turned(turn, point)); }
  Frame place(const Frame& inner) const { return {place(inner.origin), product(turn, inner.turn)}; }
  /// What place() makes `other` of.
  Frame seen(const Frame& other) const {
    const Quat back{-turn[0], -turn[1], -turn[2], turn[3]};
    return {turned(back, minus(other.origin, origin)), product(back, other.turn)};
  }
};

}  // namespace boxstream::geometry
