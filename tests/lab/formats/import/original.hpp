// SPDX-License-Identifier: MIT
#pragma once

#include <LinearMath/btSerializer.h>
#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace boxstream::import_test {

/// A world of Bullet's own, to be written by Bullet's own serializer.
class Original {
 public:
  Original() { world_.setGravity(btVector3(0, -5, 0)); }
  ~Original() {
    for (auto& joint : joints_) world_.removeConstraint(joint.get());
    for (auto& body : bodies_) world_.removeRigidBody(body.get());
  }
  Original(const Original&) = delete;
  Original& operator=(const Original&) = delete;

  template <class Shape, class... Arguments>
  Shape& shape(Arguments... arguments) {
    auto made = std::make_unique<Shape>(arguments...);
    Shape& result = *made;
    shapes_.push_back(std::move(made));
    return result;
  }

  btRigidBody& body(btScalar mass, btCollisionShape& shape, const btVector3& place,
                    const btQuaternion& turn = btQuaternion::getIdentity()) {
    btVector3 inertia(0, 0, 0);
    if (mass > 0) shape.calculateLocalInertia(mass, inertia);
    btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape, inertia);
    info.m_startWorldTransform = btTransform(turn, place);
    bodies_.push_back(std::make_unique<btRigidBody>(info));
    world_.addRigidBody(bodies_.back().get());
    return *bodies_.back();
  }

  template <class Joint>
  Joint& join(std::unique_ptr<Joint> joint) {
    Joint& result = *joint;
    world_.addConstraint(joint.get(), true);
    joints_.push_back(std::move(joint));
    return result;
  }

  std::string bytes() {
    btDefaultSerializer serializer;
    world_.serialize(&serializer);
    return {reinterpret_cast<const char*>(serializer.getBufferPointer()),
            static_cast<std::size_t>(serializer.getCurrentBufferSize())};
  }

  const std::vector<std::unique_ptr<btRigidBody>>& bodies() const { return bodies_; }
  btDiscreteDynamicsWorld& world() { return world_; }

 private:
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_{&dispatcher_, &broadphase_, &solver_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btRigidBody>> bodies_;
  std::vector<std::unique_ptr<btTypedConstraint>> joints_;
};

}  // namespace boxstream::import_test
