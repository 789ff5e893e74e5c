// SPDX-License-Identifier: MIT
#include "simulation/engine/link_joint.hpp"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <algorithm>
#include <numbers>

namespace boxstream::scenes {
namespace {

using Axis = std::array<double, 2>;
using Axes = std::array<Axis, 3>;

bool is_locked(const Axis& axis) {
  return axis[0] == 0 && axis[1] == 0;
}

/// A low end above the high one means none; a whole turn ends nowhere.
std::optional<Axis> bounded(std::optional<Axis> limits, bool turns) {
  if (!limits || (*limits)[0] > (*limits)[1]) return std::nullopt;
  if (turns && (*limits)[1] - (*limits)[0] >= 2 * std::numbers::pi * (1 - 1e-9)) return std::nullopt;
  return limits;
}

std::optional<Motor> acting(const std::optional<Motor>& motor) {
  return motor && motor->acts() ? motor : std::nullopt;
}

/// The one of three axes that is not locked; none if it is not the only one.
std::optional<std::size_t> only_open(const Axes& axes) {
  std::optional<std::size_t> open;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (is_locked(axes[axis])) continue;
    if (open) return std::nullopt;
    open = axis;
  }
  return open;
}

bool all_locked(const Axes& axes) {
  return std::all_of(axes.begin(), axes.end(), is_locked);
}

Vec3 unit(std::size_t axis) {
  Vec3 v{};
  v[axis] = 1;
  return v;
}

struct AsLink {
  using Found = std::optional<LinkJoint>;

  Found operator()(const BallJoint& ball) const { return LinkJoint{LinkJoint::spherical, ball.pivot}; }
  Found operator()(const FixedJoint& joint) const { return LinkJoint{LinkJoint::fixed, joint.pivot}; }
  Found operator()(const HingeJoint& hinge) const {
    return LinkJoint{LinkJoint::revolute, hinge.pivot, hinge.axis, bounded(hinge.limits, true), acting(hinge.motor)};
  }
  Found operator()(const SliderJoint& slider) const {
    return LinkJoint{LinkJoint::prismatic, slider.pivot, slider.axis, bounded(slider.limits, false),
                     acting(slider.motor)};
  }
  Found operator()(const SixDofJoint& joint) const {
    const auto is_free = [](const Axis& axis) { return axis[0] > axis[1]; };
    const bool no_ways = all_locked(joint.linear), no_turns = all_locked(joint.angular);
    if (no_ways && no_turns) return LinkJoint{LinkJoint::fixed, joint.pivot};
    if (no_ways && std::all_of(joint.angular.begin(), joint.angular.end(), is_free))
      return LinkJoint{LinkJoint::spherical, joint.pivot};
    const auto turn = only_open(joint.angular), way = only_open(joint.linear);
    if (no_ways && turn)
      return LinkJoint{LinkJoint::revolute, joint.pivot, unit(*turn), bounded(joint.angular[*turn], true)};
    if (no_turns && way)
      return LinkJoint{LinkJoint::prismatic, joint.pivot, unit(*way), bounded(joint.linear[*way], false)};
    return std::nullopt;
  }
  template <class Other>
  Found operator()(const Other&) const {
    return std::nullopt;
  }
};

}  // namespace

std::optional<LinkJoint> link_joint(const Joint& joint) {
  std::optional<LinkJoint> found = std::visit(AsLink{}, joint.value);
  if (found) found->a = joint.a, found->b = joint.b;
  return found;
}

std::string why_no_link(const JointValue& joint) {
  if (std::holds_alternative<SixDofJoint>(joint)) return "a 6dof with several axes that are not locked";
  return std::visit([](const auto& value) { return std::string("a ") + value.kind; }, joint);
}

JointLimit::JointLimit(btMultiBody& multibody, int link, btScalar low, btScalar high)
    : btMultiBodyConstraint(&multibody, nullptr, link, -1, 2, true, MULTIBODY_CONSTRAINT_LIMIT),
      low_(low),
      high_(high) {
  m_maxAppliedImpulse = BT_LARGE_FLOAT;
}

void JointLimit::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  const int coordinate = 6 + m_bodyA->getLink(m_linkA).m_dofOffset;
  jacobianA(0)[coordinate] = 1;
  jacobianA(1)[coordinate] = -1;
  m_numDofsFinalized = m_jacSizeBoth;
}

int JointLimit::getIslandIdA() const {
  return m_bodyA->getLink(m_linkA).m_collider->getIslandTag();
}

// A row for each end: the joint comes no nearer to it in a step than it is away, and leaves a fifth (or what the scene
// says) of the way that it is beyond.
void JointLimit::createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                                      const btContactSolverInfo& info) {
  const btVector3 none(0, 0, 0);
  const btScalar place = m_bodyA->getJointPos(m_linkA), speed = m_bodyA->getJointVel(m_linkA);
  for (int end = 0; end < 2; ++end) {
    const btScalar room = end == 0 ? place - low_ : high_ - place, closing = end == 0 ? -speed : speed;
    if (closing * info.m_timeStep < room) {
      internalSetAppliedImpulse(end, 0);
      continue;
    }
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    row.m_orgConstraint = this;
    row.m_orgDofIndex = end;
    row.m_multiBodyB = nullptr;
    row.m_solverBodyIdA = row.m_solverBodyIdB = data.m_fixedBodyId;
    const btScalar share = room > 0 ? 1 : info.m_erp;
    fillMultiBodyConstraint(row, data, jacobianA(end), nullptr, none, none, none, none, 0, info, 0, m_maxAppliedImpulse,
                            false, 1, false, -room * share / info.m_timeStep);
  }
}

}  // namespace boxstream::scenes
