// SPDX-License-Identifier: MIT
#include "simulation/world_objects.hpp"

#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include "simulation/convert.hpp"
#include "simulation/joints.hpp"

namespace boxstream::scenes {
namespace {

struct MakeSoft {
  btSoftBodyWorldInfo& info;

  std::unique_ptr<btSoftBody> operator()(const ClothSoft& cloth) const {
    return std::unique_ptr<btSoftBody>(btSoftBodyHelpers::CreatePatch(
        info, vector(cloth.corners[0]), vector(cloth.corners[1]), vector(cloth.corners[2]), vector(cloth.corners[3]),
        cloth.resolution[0], cloth.resolution[1], cloth.pinned, true));
  }
  std::unique_ptr<btSoftBody> operator()(const BallSoft& ball) const {
    const btScalar r = real(ball.radius);
    auto body = std::unique_ptr<btSoftBody>(
        btSoftBodyHelpers::CreateEllipsoid(info, vector(ball.centre), btVector3(r, r, r), ball.resolution));
    body->m_cfg.kPR = real(ball.pressure);
    return body;
  }
};

}  // namespace

WorldObjects::WorldObjects(const Scene& scene, Expanded expanded, BulletWorld& world)
    : shapes(std::move(expanded.shapes)), world_(world), dt_(scene.time.dt / scene.time.substeps) {
  bodies.reserve(expanded.bodies.size());
  for (const Body& body : expanded.bodies) add_body(body);
  for (const Joint& joint : expanded.joints) add_joint(joint);
  for (const Sensor& sensor : scene.sensors) add_sensor(sensor);
  walkers.reserve(scene.characters.size());
  for (const Character& character : scene.characters) {
    Walker& walker = walkers.emplace_back(character, scene.world.gravity);
    number(walker.ghost());
    world_.world().addCollisionObject(&walker.ghost(), btBroadphaseProxy::CharacterFilter,
                                      btBroadphaseProxy::AllFilter);
    world_.world().addAction(&walker.controller());
  }
  for (const SoftBody& soft : scene.soft_bodies) add_soft_body(soft);
}

WorldObjects::~WorldObjects() {
  btDiscreteDynamicsWorld& world = world_.world();
  world_.end_all_pairs();
  for (auto& joint : joints) world.removeConstraint(joint.get());
  for (Walker& walker : walkers) world.removeAction(&walker.controller());
  for (auto soft = soft_bodies.rbegin(); soft != soft_bodies.rend(); ++soft)
    world_.soft_world()->removeSoftBody(soft->get());
  for (auto walker = walkers.rbegin(); walker != walkers.rend(); ++walker)
    world.removeCollisionObject(&walker->ghost());
  for (auto sensor = sensors.rbegin(); sensor != sensors.rend(); ++sensor) world.removeCollisionObject(sensor->get());
  for (auto body = bodies.rbegin(); body != bodies.rend(); ++body) world.removeRigidBody(body->get());
}

void WorldObjects::number(btCollisionObject& object) {
  object.setUserIndex(static_cast<int>(objects.size()));
  objects.push_back(&object);
}

void WorldObjects::add_body(const Body& description) {
  const BodyTraits& traits = description.traits;
  const BuiltShape& built = shapes.get(traits.shape);
  btVector3 inertia(0, 0, 0);
  btScalar mass = 0;
  if (traits.type == BodyType::dynamic) {
    mass = real(traits.mass ? *traits.mass : *traits.density * built.volume);
    built.shape->calculateLocalInertia(mass, inertia);
  }
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, built.shape.get(), inertia);
  info.m_startWorldTransform = transform(description.position, description.rotation);
  info.m_startWorldTransform.getOrigin() += info.m_startWorldTransform.getBasis() * btVector3(0, built.lift, 0);
  info.m_friction = real(traits.material.friction);
  info.m_rollingFriction = real(traits.material.rolling);
  info.m_spinningFriction = real(traits.material.spinning);
  info.m_restitution = real(traits.material.restitution);
  info.m_linearDamping = real(traits.linear_damping);
  info.m_angularDamping = real(traits.angular_damping);
  auto body = std::make_unique<btRigidBody>(info);
  if (traits.type == BodyType::dynamic) {
    body->setLinearVelocity(vector(description.velocity));
    body->setAngularVelocity(vector(description.spin));
  } else if (traits.type == BodyType::kinematic) {
    body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
    moved.push_back({body.get(), vector(description.velocity), vector(description.spin)});
  }
  if (!traits.sleep || traits.type == BodyType::kinematic) body->setActivationState(DISABLE_DEACTIVATION);
  if (traits.ccd) {
    body->setCcdMotionThreshold(real(traits.ccd->threshold));
    body->setCcdSweptSphereRadius(real(traits.ccd->radius));
  }
  number(*body);
  shape_of.push_back(traits.shape);
  built_.push_back(&built);
  if (traits.group || traits.mask) {
    world_.world().addRigidBody(body.get(), static_cast<int>(traits.group.value_or(btBroadphaseProxy::DefaultFilter)),
                                static_cast<int>(traits.mask.value_or(0x7fffffff)));
  } else {
    world_.world().addRigidBody(body.get());
  }
  bodies.push_back(std::move(body));
}

void WorldObjects::add_joint(const Joint& description) {
  btRigidBody* const b = description.b ? bodies[*description.b].get() : nullptr;
  joints.push_back(make_joint(description.value, *bodies[description.a], b, dt_));
  world_.world().addConstraint(joints.back().get(), !description.collide);
}

void WorldObjects::add_sensor(const Sensor& description) {
  sensor_shapes.push_back(std::make_unique<btBoxShape>(vector(description.half_extents)));
  auto ghost = std::make_unique<btGhostObject>();
  ghost->setCollisionShape(sensor_shapes.back().get());
  ghost->setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  ghost->setWorldTransform(transform(description.position, {0, 0, 0, 1}));
  number(*ghost);
  world_.world().addCollisionObject(
      ghost.get(), btBroadphaseProxy::SensorTrigger,
      btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::SensorTrigger ^ btBroadphaseProxy::StaticFilter);
  sensors.push_back(std::move(ghost));
}

void WorldObjects::add_soft_body(const SoftBody& description) {
  btSoftRigidDynamicsWorld& world = *world_.soft_world();
  std::unique_ptr<btSoftBody> soft = std::visit(MakeSoft{world.getWorldInfo()}, description.value);
  btSoftBody::Material* const material = soft->m_materials[0];
  material->m_kLST = real(description.stiffness);
  material->m_kAST = real(description.stiffness);
  soft->generateBendingConstraints(2, material);
  // Shares by area would give pinned nodes a mass again; the nodes of a cloth are evenly spread anyway.
  soft->setTotalMass(real(description.mass), std::holds_alternative<BallSoft>(description.value));
  soft->m_cfg.kDP = real(description.damping);
  soft->m_cfg.kDF = real(description.friction);
  soft->m_cfg.piterations = description.iterations;
  soft->m_cfg.collisions = btSoftBody::fCollision::SDF_RS | btSoftBody::fCollision::VF_SS;
  soft->getCollisionShape()->setMargin(real(description.margin));
  number(*soft);
  world.addSoftBody(soft.get());
  soft_bodies.push_back(std::move(soft));
}

}  // namespace boxstream::scenes
