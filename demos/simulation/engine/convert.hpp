// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btTransform.h>

#include "formats/scene_model/scene.hpp"

namespace boxstream::scenes {

inline btScalar real(double value) {
  return static_cast<btScalar>(value);
}
inline btVector3 vector(const Vec3& v) {
  return btVector3(real(v[0]), real(v[1]), real(v[2]));
}
inline Vec3 exact(const btVector3& v) {
  return {double{v.x()}, double{v.y()}, double{v.z()}};
}
inline btQuaternion quaternion(const Quat& q) {
  return btQuaternion(real(q[0]), real(q[1]), real(q[2]), real(q[3]));
}
inline btTransform transform(const Vec3& place, const Quat& rotation) {
  return btTransform(quaternion(rotation), vector(place));
}
/// Closed; a place that is not a number is outside.
inline bool is_inside(const Bounds& bounds, const btVector3& place) {
  for (std::size_t d = 0; d < 3; ++d)
    if (const double x = place[static_cast<int>(d)]; !(x >= bounds.min[d] && x <= bounds.max[d])) return false;
  return true;
}
inline std::array<float, 3> plain(const btVector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}
inline std::array<float, 4> plain(const btQuaternion& q) {
  return {static_cast<float>(q.x()), static_cast<float>(q.y()), static_cast<float>(q.z()), static_cast<float>(q.w())};
}

}  // namespace boxstream::scenes
