// SPDX-License-Identifier: MIT
#include "simulation/run/joint_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <btBulletDynamicsCommon.h>

namespace boxstream::scenes {
namespace {

using Point = double[3];

/// In doubles: a joint's error is the small difference of two places.
void put(const btTransform& place, const btVector3& local, Point& out) {
  for (int row = 0; row < 3; ++row) {
    out[row] = place.getOrigin()[row];
    for (int k = 0; k < 3; ++k) out[row] += double{place.getBasis()[row][k]} * local[k];
  }
}

double gap(const btTypedConstraint& joint, const btVector3& in_a, const btVector3& in_b) {
  Point a, b;
  put(joint.getRigidBodyA().getWorldTransform(), in_a, a);
  put(joint.getRigidBodyB().getWorldTransform(), in_b, b);
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Between two directions, each given in its body. Crossed and not multiplied, for small angles.
double turn(const btTypedConstraint& joint, const btVector3& in_a, const btVector3& in_b) {
  const btVector3 a = joint.getRigidBodyA().getWorldTransform().getBasis() * in_a;
  const btVector3 b = joint.getRigidBodyB().getWorldTransform().getBasis() * in_b;
  return std::atan2(double{a.cross(b).length()}, double{a.dot(b)}) * 180 / std::numbers::pi;
}

/// The diagonal of a body's box.
double size_of(const btRigidBody& body) {
  if (body.getInvMass() == 0 || body.getCollisionShape() == nullptr) return std::numeric_limits<double>::infinity();
  btVector3 low, high;
  body.getCollisionShape()->getAabb(btTransform::getIdentity(), low, high);
  return double{(high - low).length()};
}

/// What a gap is large or small against.
double scale_of(const btTypedConstraint& joint, const btVector3& in_a, const btVector3& in_b) {
  const btRigidBody &a = joint.getRigidBodyA(), &b = joint.getRigidBodyB();
  const double lever =
      std::max(a.getInvMass() > 0 ? double{in_a.length()} : 0.0, b.getInvMass() > 0 ? double{in_b.length()} : 0.0);
  const double size = std::min(size_of(a), size_of(b));
  return std::max(lever, std::isfinite(size) ? size : 0.0);
}

void take(const btTypedConstraint& joint, JointError& worst) {
  const auto holds = [&](const btVector3& in_a, const btVector3& in_b) {
    const double distance = gap(joint, in_a, in_b);
    if (distance > worst.distance) {
      worst.distance = distance;
      worst.widest = &joint;
    }
    worst.share = std::max(worst.share, distance / scale_of(joint, in_a, in_b));
  };
  const auto aligns = [&](const btTransform& a, const btTransform& b, int axis) {
    worst.degrees = std::max(worst.degrees, turn(joint, a.getBasis().getColumn(axis), b.getBasis().getColumn(axis)));
  };
  switch (joint.getConstraintType()) {
    case POINT2POINT_CONSTRAINT_TYPE: {
      const auto& ball = static_cast<const btPoint2PointConstraint&>(joint);
      holds(ball.getPivotInA(), ball.getPivotInB());
      break;
    }
    case HINGE_CONSTRAINT_TYPE: {
      const auto& hinge = static_cast<const btHingeConstraint&>(joint);
      holds(hinge.getAFrame().getOrigin(), hinge.getBFrame().getOrigin());
      aligns(hinge.getAFrame(), hinge.getBFrame(), 2);
      break;
    }
    case CONETWIST_CONSTRAINT_TYPE: {
      const auto& cone = static_cast<const btConeTwistConstraint&>(joint);
      holds(cone.getAFrame().getOrigin(), cone.getBFrame().getOrigin());
      break;
    }
    default:
      // Bullet gives this one the type of its base class.
      if (const auto* const fixed = dynamic_cast<const btFixedConstraint*>(&joint)) {
        const btTransform &a = fixed->getFrameOffsetA(), &b = fixed->getFrameOffsetB();
        holds(a.getOrigin(), b.getOrigin());
        for (int axis = 0; axis < 3; ++axis) aligns(a, b, axis);
      }
  }
}

}  // namespace

JointError joint_error(const btDynamicsWorld& world) {
  JointError worst;
  for (int i = 0; i < world.getNumConstraints(); ++i) take(*world.getConstraint(i), worst);
  return worst;
}

JointError joint_error(const btTypedConstraint& joint) {
  JointError own;
  take(joint, own);
  return own;
}

}  // namespace boxstream::scenes
