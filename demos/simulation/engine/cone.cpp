// SPDX-License-Identifier: MIT
#include "simulation/engine/cone.hpp"

#include "formats/geometry/solid.hpp"
#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {

// Sides and base move inwards by the margin: the apex by as much as the sides make of it.
Cone::Cone(btScalar radius, btScalar height, btScalar middle, btScalar margin)
    : sine_(radius / btSqrt(radius * radius + height * height)) {
  base_ = middle - height / 2 + margin;
  apex_ = middle + height / 2 - (margin > 0 ? margin / sine_ : 0);
  radius_ = (apex_ - base_) * (radius / height);
  m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
  setMargin(margin);
}

btVector3 Cone::localGetSupportingVertexWithoutMargin(const btVector3& direction) const {
  if (direction.y() > direction.length() * sine_) return btVector3(0, apex_, 0);
  const btScalar across = btSqrt(direction.x() * direction.x() + direction.z() * direction.z());
  if (!(across > 0)) return btVector3(0, base_, 0);
  return btVector3(direction.x() / across * radius_, base_, direction.z() / across * radius_);
}

void Cone::batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* corners,
                                                             int count) const {
  for (int i = 0; i < count; ++i) corners[i] = localGetSupportingVertexWithoutMargin(directions[i]);
}

// The apex, and the disk at the base: its extent along an axis is the sine of its own axis' angle to it.
void Cone::getAabb(const btTransform& place, btVector3& low, btVector3& high) const {
  const btVector3 axis = place.getBasis().getColumn(1), apex = place * btVector3(0, apex_, 0),
                  base = place * btVector3(0, base_, 0);
  btVector3 extent;
  for (int d = 0; d < 3; ++d) extent[d] = radius_ * btSqrt(btMax(btScalar(0), 1 - axis[d] * axis[d]));
  low = base - extent, high = base + extent;
  low.setMin(apex), high.setMax(apex);
  const btVector3 margin(getMargin(), getMargin(), getMargin());
  low -= margin, high += margin;
}

void Cone::calculateLocalInertia(btScalar mass, btVector3& inertia) const {
  const geometry::Solid solid = geometry::cone(double{radius_}, double{apex_ - base_});
  for (int d = 0; d < 3; ++d) {
    const auto i = static_cast<std::size_t>(d);
    inertia[d] = mass * real(solid.inertia[i][i] / solid.volume);
  }
}

}  // namespace boxstream::scenes
