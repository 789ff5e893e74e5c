// SPDX-License-Identifier: MIT
// An arm of capsules among balls, in Pinocchio: the manager is the parameter of its broad-phase, so one line changes.
#include <pinocchio/fwd.hpp>  // before Boost, which others of these include

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>

#include <coal/broadphase/broadphase_dynamic_AABB_tree.h>
#include <coal/shape/geometric_shapes.h>
#include <boxstream/coal.hpp>
#include <pinocchio/algorithm/geometry.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/collision/broadphase.hpp>
#include <pinocchio/multibody/geometry.hpp>
#include <pinocchio/multibody/joint/joint-revolute.hpp>

namespace {

struct Robot {
  pinocchio::Model model;
  pinocchio::GeometryModel geometry;
};

Robot make_robot() {
  using pinocchio::GeometryObject, pinocchio::SE3;
  Robot robot;
  pinocchio::JointIndex joint = 0;
  for (int i = 0; i < 7; ++i) {
    const SE3 place(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, i == 0 ? 0 : 0.4));
    const std::string name = "link" + std::to_string(i);
    joint = i % 2 == 0 ? robot.model.addJoint(joint, pinocchio::JointModelRY(), place, name)
                       : robot.model.addJoint(joint, pinocchio::JointModelRX(), place, name);
    robot.geometry.addGeometryObject(GeometryObject(name, joint,
                                                    SE3(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 0.2)),
                                                    std::make_shared<coal::Capsule>(0.05, 0.3)));
  }
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d at(0.5 * (i % 4) - 0.75, 0.5 * (i / 4 % 4) - 0.75, 0.6 * (i / 16) + 0.3);
    robot.geometry.addGeometryObject(GeometryObject("ball" + std::to_string(i), 0, SE3(Eigen::Matrix3d::Identity(), at),
                                                    std::make_shared<coal::Sphere>(0.1)));
  }
  for (std::size_t a = 0; a < 7; ++a)
    for (std::size_t b = a + 2; b < robot.geometry.geometryObjects.size(); ++b)  // not with the next link
      robot.geometry.addCollisionPair(pinocchio::CollisionPair(a, b));
  return robot;
}

template <class Manager>
int count_collisions(const Robot& robot) {
  pinocchio::Data data(robot.model);
  pinocchio::GeometryData geometry(robot.geometry);
  pinocchio::BroadPhaseManagerTpl<Manager> broad_phase(&robot.model, &robot.geometry, &geometry);
  int collisions = 0;
  for (int pose = 0; pose < 200; ++pose) {
    Eigen::VectorXd q(robot.model.nq);
    for (int i = 0; i < robot.model.nq; ++i) q[i] = std::sin(0.1 * pose + i) * 1.5;
    pinocchio::computeCollisions(robot.model, data, broad_phase, q, false);
    for (const auto& result : geometry.collisionResults) collisions += result.isCollision();
  }
  return collisions;
}

}  // namespace

int main() {
  const Robot robot = make_robot();
  const int native = count_collisions<coal::DynamicAABBTreeCollisionManager>(robot);
  const int ours = count_collisions<boxstream::coal::CollisionManager>(robot);
  std::printf("%d collisions on Coal's tree, %d on boxstream\n", native, ours);
  return native == ours && ours > 0 ? 0 : 1;
}
