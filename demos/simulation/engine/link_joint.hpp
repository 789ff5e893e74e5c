// SPDX-License-Identifier: MIT
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>
#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "formats/scene_model/joints.hpp"

namespace boxstream::scenes {

/// Where a hinge or slider of a multibody ends. Bullet's own lets it come as far beyond an end as it moves in a step,
/// and pushes it back after that; this one stops it there.
class JointLimit final : public btMultiBodyConstraint {
 public:
  JointLimit(btMultiBody& multibody, int link, btScalar low, btScalar high);

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  btScalar low_, high_;
};

/// A joint as the coordinates of a multibody have it.
struct LinkJoint {
  enum Kind { revolute, prismatic, spherical, fixed } kind;
  Vec3 pivot;
  Vec3 axis{};                                    ///< of the world; of revolute and prismatic ones
  std::optional<std::array<double, 2>> limits{};  ///< radians or metres
  std::optional<Motor> motor{};                   ///< one that acts
  std::size_t a = 0;                              ///< the first body
  std::optional<std::size_t> b{};                 ///< the second one; none: the world

  /// Whether it can be had as rows of the solver, between two links of one tree.
  bool may_close() const { return (kind == spherical || kind == revolute) && !limits && !motor; }
};

/// None if a multibody cannot have it.
std::optional<LinkJoint> link_joint(const Joint& joint);

/// Why not: as "a gear". To be asked of those that are none.
std::string why_no_link(const JointValue& joint);

}  // namespace boxstream::scenes
