// SPDX-License-Identifier: MIT
#include "simulation/effects/scene_instance.hpp"

#include <algorithm>
#include <string_view>

#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>

#include "simulation/engine/convert.hpp"
#include "simulation/engine/mass.hpp"

namespace boxstream::effects {

using scenes::Body;
using scenes::BodyTraits;
using scenes::BodyType;
using scenes::real;
using scenes::vector;

SceneInstance::SceneInstance(const scenes::Scene& s, scenes::Expanded e, scenes::BulletWorld& w)
    : scene(s),
      expanded(std::move(e)),
      subject(scene, expanded),
      world(w),
      substep(scene.time.dt / scene.time.substeps),
      shapes(expanded.shapes) {}

void SceneInstance::build(const Plan& plan) {
  bodies.reserve(expanded.bodies.size());
  for (const Body& body : expanded.bodies) add_body(plan, body);
  for (const Decision& decision : plan)
    if (decision.on && decision.effect->build.start != nullptr) decision.effect->build.start(*this);
}

SceneInstance::~SceneInstance() {
  btDiscreteDynamicsWorld& bullet = world.world();
  world.end_all_pairs();
  multibodies.reset();
  for (auto& joint : joints) bullet.removeConstraint(joint.get());
  joints.clear();
  for (Car& car : cars) bullet.removeAction(car.vehicle.get());
  for (Walker& walker : walkers) bullet.removeAction(&walker.controller());
  for (auto soft = soft_bodies.rbegin(); soft != soft_bodies.rend(); ++soft)
    world.soft_world()->removeSoftBody(soft->get());
  for (auto walker = walkers.rbegin(); walker != walkers.rend(); ++walker)
    bullet.removeCollisionObject(&walker->ghost());
  for (auto sensor = sensors.rbegin(); sensor != sensors.rend(); ++sensor) bullet.removeCollisionObject(sensor->get());
  // Bullet searches its list from the front, and moves the last one to where one has left.
  for (auto& moving = bullet.getNonStaticRigidBodies(); moving.size() > 0;) bullet.removeRigidBody(moving[0]);
  for (std::size_t i = bodies.size(); i-- > 0;) leave(i);
}

void SceneInstance::number(btCollisionObject& object) {
  object.setUserIndex(static_cast<int>(objects.size()));
  objects.push_back(&object);
}

btTransform SceneInstance::described(std::size_t body) const {
  const BodyFrame& frame = frames_[body];
  const btTransform& place = bodies[body]->getWorldTransform();
  return frame.is_described ? place : place * frame.back;
}

void SceneInstance::put(std::size_t body, const btTransform& pose) {
  const BodyFrame& frame = frames_[body];
  bodies[body]->setWorldTransform(frame.is_described ? pose : pose * frame.of_body);
}

// Everything is off in a body that is made here: no friction, no bounce, no damping, no gyroscopic term, no sleep, no
// sweeping. Bullet has some of these on by default.
void SceneInstance::add_body(const Plan& plan, const Body& description) {
  const BodyTraits& traits = description.traits;
  const scenes::Mass mass = scenes::mass_of(description, shapes.solid(traits.shape));
  const scenes::BuiltShape& shape = shapes.get(traits.shape, mass.frame);
  const geometry::Frame& frame = shape.frame;
  const btTransform of_body = scenes::transform(frame.origin, frame.turn);
  frames_.push_back(
      {of_body, of_body.inverse(), frame.origin == scenes::Vec3{} && frame.turn == scenes::Quat{0, 0, 0, 1}});
  btRigidBody::btRigidBodyConstructionInfo info(real(mass.mass), nullptr, shape.shape.get(), vector(mass.moments));
  info.m_startWorldTransform = scenes::transform(description.position, description.rotation);
  if (!frames_.back().is_described) info.m_startWorldTransform *= of_body;
  info.m_friction = 0;
  constexpr double heavy = 1e6;  // kg
  if (mass.mass > heavy) world.solver().expect_heavy_bodies();
  auto body = std::make_unique<btRigidBody>(info);
  body->setFlags(0);
  if (traits.type == BodyType::dynamic) {
    body->setLinearVelocity(vector(description.velocity));
    body->setAngularVelocity(vector(description.spin));
  }
  // Static bodies sleep once they are in the world, and cost nothing then.
  if (traits.type != BodyType::fixed) body->setActivationState(DISABLE_DEACTIVATION);
  for (const Decision& decision : plan)
    if (decision.on && decision.effect->build.configure_body != nullptr)
      decision.effect->build.configure_body(subject, description, *body);
  number(*body);
  built_.push_back(&shape);
  bodies.push_back(std::move(body));
  if (!description.late) enter(bodies.size() - 1);
}

void SceneInstance::enter(std::size_t index) {
  btRigidBody& body = *bodies[index];
  if (body.isInWorld()) return;
  const BodyTraits& traits = expanded.bodies[index].traits;
  if (traits.group || traits.mask) {
    world.world().addRigidBody(&body, static_cast<int>(traits.group.value_or(btBroadphaseProxy::DefaultFilter)),
                               static_cast<int>(traits.mask.value_or(0x7fffffff)));
  } else {
    world.world().addRigidBody(&body);
  }
}

void SceneInstance::leave(std::size_t index) {
  btRigidBody& body = *bodies[index];
  if (!body.isInWorld()) return;
  for (const auto& joint : joints)
    if (&joint->getRigidBodyA() == &body || &joint->getRigidBodyB() == &body)
      world.world().removeConstraint(joint.get());
  world.world().removeRigidBody(&body);
}

void SceneInstance::run(std::vector<Hook>& hooks, double dt) {
  for (Hook& hook : hooks) {
    ++hook.calls;
    hook.run(dt);
  }
}

bool SceneInstance::is_on(const Decision& decision) const {
  const auto is_it = [&](const SwitchedOn& late) { return late.effect == decision.effect; };
  return decision.on || std::any_of(switched_on.begin(), switched_on.end(), is_it);
}

void SceneInstance::observe_activity(const Plan& plan) {
  activity.resize(plan.size());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Effect::Activity& what = plan[i].effect->activity;
    if (!is_on(plan[i]) || what.count == nullptr) continue;
    const std::uint64_t count = what.count(*this);
    activity[i] = what.extent == Effect::Activity::of_run ? count : activity[i] + count;
  }
}

void SceneInstance::before_step(const Effect& effect, std::function<void(double)> hook) {
  first.push_back({&effect, std::move(hook)});
}
void SceneInstance::before_substep(const Effect& effect, std::function<void(double)> hook) {
  before.push_back({&effect, std::move(hook)});
}
void SceneInstance::before_solver(const Effect& effect, std::function<void(double)> hook) {
  solver.push_back({&effect, std::move(hook)});
  world.hooks.before_solver = [this](double dt) { run(solver, dt); };
}
void SceneInstance::before_motion(const Effect& effect, std::function<void(double)> hook) {
  motion.push_back({&effect, std::move(hook)});
  world.hooks.before_motion = [this](double dt) { run(motion, dt); };
}
void SceneInstance::after_motion(const Effect& effect, std::function<void(double)> hook) {
  moved.push_back({&effect, std::move(hook)});
  world.hooks.after_motion = [this](double dt) { run(moved, dt); };
}
void SceneInstance::after_substep(const Effect& effect, std::function<void(double)> hook) {
  after.push_back({&effect, std::move(hook)});
}
void SceneInstance::after_step(const Effect& effect, std::function<void(double)> hook) {
  last.push_back({&effect, std::move(hook)});
}

}  // namespace boxstream::effects
