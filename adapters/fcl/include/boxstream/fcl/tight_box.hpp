// SPDX-License-Identifier: MIT
#pragma once

#include <boxstream/cxx17.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <fcl/narrowphase/collision_object.h>

#include <boxstream/detail/float_environment.hpp>

namespace boxstream::fcl {

/// A box source for CollisionManager::setBoxSource that follows the rotation of the object:
///
///     manager.setBoxSource(boxstream::fcl::tightBox<double>);
///
/// computeAABB() gives every object that is turned a cube, around the sphere around its local box. This is the box of
/// the turned local box instead, and for spheres, ellipsoids, capsules and cylinders that of the shape itself, rounded
/// outward. It is never larger than the cube but for rounding. The box of a mesh without vertices is empty.
///
/// It takes the object's transform and local box as they are now: computeAABB() need not have been called, and what
/// was written into the object's box, to make it larger, does not count. Planes, half-spaces and octrees keep
/// getAABB().
template <class S>
::fcl::AABB<S> tightBox(const ::fcl::CollisionObject<S>& object) {
  const ::fcl::CollisionGeometry<S>& geometry = *object.collisionGeometry();
  const ::fcl::NODE_TYPE type = geometry.getNodeType();
  if (type == ::fcl::GEOM_PLANE || type == ::fcl::GEOM_HALFSPACE || type == ::fcl::GEOM_OCTREE) return object.getAABB();

  const boxstream::detail::DefaultFloatEnvironment environment;
  for (int i = 0; i < 3; ++i)
    if (geometry.aabb_local.min_[i] > geometry.aabb_local.max_[i]) return ::fcl::AABB<S>();  // of an empty mesh
  const ::fcl::Transform3<S>& transform = object.getTransform();
  const ::fcl::Vector3<S> half = (geometry.aabb_local.max_ - geometry.aabb_local.min_) / 2;
  const ::fcl::Vector3<S> middle = transform * ((geometry.aabb_local.min_ + geometry.aabb_local.max_) / 2).eval();
  ::fcl::AABB<S> box;
  for (int i = 0; i < 3; ++i) {
    const S x = std::abs(transform.linear()(i, 0)), y = std::abs(transform.linear()(i, 1));
    const S z = std::abs(transform.linear()(i, 2));
    S reach;
    if (type == ::fcl::GEOM_SPHERE)
      reach = half[0];
    else if (type == ::fcl::GEOM_ELLIPSOID)
      reach = std::hypot(x * half[0], y * half[1], z * half[2]);
    else if (type == ::fcl::GEOM_CAPSULE)
      reach = z * (half[2] - half[0]) + half[0];
    else if (type == ::fcl::GEOM_CYLINDER)
      reach = z * half[2] + std::hypot(x, y) * half[0];
    else
      reach = std::min(x * half[0] + y * half[1] + z * half[2], geometry.aabb_radius);
    constexpr S slack = 8 * std::numeric_limits<S>::epsilon();
    const S sum = std::abs(middle[i]) + reach + geometry.aabb_local.min_.cwiseAbs().maxCoeff();
    box.min_[i] = middle[i] - reach - slack * sum;
    box.max_[i] = middle[i] + reach + slack * sum;
  }
  return box;
}

}  // namespace boxstream::fcl
