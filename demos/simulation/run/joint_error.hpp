// SPDX-License-Identifier: MIT
#pragma once

class btDynamicsWorld;
class btTypedConstraint;

namespace boxstream::scenes {

/// The largest of all joints of a world. Sliders, springs and joints with free axes are excluded: their ends may
/// separate.
struct JointError {
  double distance = 0;  ///< m, between the two ends of a joint that holds a point
  double share = 0;     ///< of the longest way from the joint to a centre of mass, or the smaller body's size
  double degrees = 0;   ///< between the axes of a hinge, or the sides of a fixed joint
  const btTypedConstraint* widest = nullptr;  ///< that of the distance; null: none is apart
};

JointError joint_error(const btDynamicsWorld& world);

/// Of one joint.
JointError joint_error(const btTypedConstraint& joint);

}  // namespace boxstream::scenes
