// SPDX-License-Identifier: MIT
#include "users/bullet_game.hpp"

#include <fmt/core.h>

#include <BulletDynamics/Character/btKinematicCharacterController.h>

#include <algorithm>
#include <utility>

namespace boxstream::bench {

namespace {

constexpr btScalar time_step = btScalar(1) / 60;

double now_ms() {
  return measure::milliseconds(measure::now());
}

using Ids = std::pair<int, int>;

Ids ids_of(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  return std::minmax(a.m_uniqueId, b.m_uniqueId);
}

bool touch(const btBroadphaseProxy& a, const btBroadphaseProxy& b) {
  for (int d = 0; d < 3; ++d)
    if (!(a.m_aabbMin[d] <= b.m_aabbMax[d] && b.m_aabbMin[d] <= a.m_aabbMax[d])) return false;
  return true;
}

/// Sorted; by a sweep along x.
std::vector<Ids> expected_pairs(std::vector<btBroadphaseProxy*> proxies, const btOverlappingPairCache& cache) {
  std::sort(proxies.begin(), proxies.end(),
            [](const btBroadphaseProxy* a, const btBroadphaseProxy* b) { return a->m_aabbMin.x() < b->m_aabbMin.x(); });
  std::vector<Ids> pairs;
  for (std::size_t i = 0; i < proxies.size(); ++i)
    for (std::size_t k = i + 1; k < proxies.size() && proxies[k]->m_aabbMin.x() <= proxies[i]->m_aabbMax.x(); ++k)
      if (touch(*proxies[i], *proxies[k]) && cache.needsBroadphaseCollision(proxies[i], proxies[k]))
        pairs.push_back(ids_of(*proxies[i], *proxies[k]));
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

/// Takes the time of the parts of its step.
class Game::TimedWorld final : public btDiscreteDynamicsWorld {
 public:
  TimedWorld(Game& game)
      : btDiscreteDynamicsWorld(game.dispatcher_.get(), game.broadphase_.get(), game.solver_.get(),
                                game.configuration_.get()) {}

  void performDiscreteCollisionDetection() override {
    const double start = now_ms();
    updateAabbs();
    const double updated = now_ms();
    computeOverlappingPairs();
    const double found = now_ms();
    if (after_pairs) after_pairs();
    const double checked = now_ms();
    getDispatcher()->dispatchAllCollisionPairs(m_broadphasePairCache->getOverlappingPairCache(), getDispatchInfo(),
                                               getDispatcher());
    const double dispatched = now_ms();
    update_ms = updated - start;
    pairs_ms = found - updated;
    check_ms = checked - found;
    dispatch_ms = dispatched - checked;
  }

  std::function<void()> after_pairs;
  double update_ms = 0, pairs_ms = 0, check_ms = 0, dispatch_ms = 0, actions_ms = 0;
};

/// What characters do is done in actions: these two stand before and behind them.
class Game::Stopwatch final : public btActionInterface {
 public:
  Stopwatch(double& ms, bool starts) : ms_(ms), starts_(starts) {}
  void updateAction(btCollisionWorld*, btScalar) override { ms_ = starts_ ? -now_ms() : ms_ + now_ms(); }
  void debugDraw(btIDebugDraw*) override {}

 private:
  double& ms_;
  bool starts_;
};

Game::Game(const Setup& setup)
    : name_(setup.broadphase),
      random_(setup.seed),
      borrowed_(setup.borrows_cache ? new btHashedOverlappingPairCache : nullptr),
      configuration_(new btDefaultCollisionConfiguration),
      dispatcher_(new btCollisionDispatcher(configuration_.get())),
      broadphase_(make_broadphase({setup.broadphase, borrowed_.get()}, setup.reach, setup.most)),
      solver_(new btSequentialImpulseConstraintSolver),
      world_(new TimedWorld(*this)) {
  world_->setGravity(btVector3(0, btScalar(-9.81), 0));
}

Game::~Game() {
  for (const auto& action : actions_) world_->removeAction(action.get());
  for (int i = world_->getNumConstraints(); i-- > 0;) world_->removeConstraint(world_->getConstraint(i));
  for (const auto& object : objects_) world_->removeCollisionObject(object.get());
  world_.reset();
  broadphase_.reset();
}

btDiscreteDynamicsWorld& Game::world() {
  return *world_;
}

btOverlappingPairCache& Game::pair_cache() {
  return *broadphase_->getOverlappingPairCache();
}

double Game::random(double low, double high) {
  return random_.range(low, high);
}

btCollisionShape* Game::keep(std::unique_ptr<btCollisionShape> shape) {
  shapes_.push_back(std::move(shape));
  return shapes_.back().get();
}

btCollisionShape* Game::box(double x, double y, double z) {
  return keep(std::make_unique<btBoxShape>(btVector3(btScalar(x), btScalar(y), btScalar(z))));
}

btCollisionShape* Game::sphere(double radius) {
  return keep(std::make_unique<btSphereShape>(btScalar(radius)));
}

btRigidBody* Game::add_body(btCollisionShape* shape, double mass, const btVector3& at) {
  using Filter = btBroadphaseProxy;
  return mass != 0 ? add_body(shape, mass, at, Filter::DefaultFilter, Filter::AllFilter)
                   : add_body(shape, mass, at, Filter::StaticFilter, Filter::AllFilter ^ Filter::StaticFilter);
}

btRigidBody* Game::add_body(btCollisionShape* shape, double mass, const btVector3& at, int group, int mask) {
  btVector3 inertia(0, 0, 0);
  if (mass != 0) shape->calculateLocalInertia(btScalar(mass), inertia);
  btRigidBody::btRigidBodyConstructionInfo info(btScalar(mass), nullptr, shape, inertia);
  info.m_startWorldTransform.setIdentity();
  info.m_startWorldTransform.setOrigin(at);
  auto body = std::make_unique<btRigidBody>(info);
  world_->addRigidBody(body.get(), group, mask);
  bodies_.push_back(body.get());
  objects_.push_back(std::move(body));
  return bodies_.back();
}

btPairCachingGhostObject* Game::add_ghost(btCollisionShape* shape, const btVector3& at) {
  pair_cache().setInternalGhostPairCallback(&ghost_callback_);
  auto ghost = std::make_unique<btPairCachingGhostObject>();
  btTransform transform = btTransform::getIdentity();
  transform.setOrigin(at);
  ghost->setWorldTransform(transform);
  ghost->setCollisionShape(shape);
  ghost->setCollisionFlags(ghost->getCollisionFlags() | btCollisionObject::CF_NO_CONTACT_RESPONSE);
  btPairCachingGhostObject* const added = ghost.get();
  world_->addCollisionObject(added, btBroadphaseProxy::SensorTrigger,
                             btBroadphaseProxy::AllFilter ^ btBroadphaseProxy::SensorTrigger);
  objects_.push_back(std::move(ghost));
  return added;
}

void Game::add_character(double radius, double height, const btVector3& at, const btVector3& walk) {
  auto* const shape = keep(std::make_unique<btCapsuleShape>(btScalar(radius), btScalar(height)));
  btPairCachingGhostObject* const ghost = add_ghost(shape, at);
  ghost->setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
  if (actions_.empty()) {
    actions_.push_back(std::make_unique<Stopwatch>(world_->actions_ms, true));
    actions_.push_back(std::make_unique<Stopwatch>(world_->actions_ms, false));
    world_->addAction(actions_.front().get());
  } else {
    world_->removeAction(actions_[1].get());  // the last one, so that all others keep their order
  }
  auto character = std::make_unique<btKinematicCharacterController>(ghost, static_cast<btConvexShape*>(shape),
                                                                    btScalar(0.35), btVector3(0, 1, 0));
  character->setWalkDirection(walk * time_step);
  world_->addAction(character.get());
  actions_.push_back(std::move(character));
  world_->addAction(actions_[1].get());
}

void Game::keep_awake() {
  for (btRigidBody* body : bodies_)
    if (!body->isStaticObject()) body->setActivationState(DISABLE_DEACTIVATION);
}

void Game::put_to_sleep() {
  for (btRigidBody* body : bodies_)
    if (!body->isStaticObject()) body->setActivationState(ISLAND_SLEEPING);
}

Game::State Game::state() const {
  State state;
  for (const btRigidBody* body : bodies_) {
    state.at.push_back(body->getWorldTransform());
    state.velocity.push_back(body->getLinearVelocity());
    state.spin.push_back(body->getAngularVelocity());
  }
  return state;
}

void Game::restore(const State& state) {
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if (bodies_[i]->isStaticObject()) continue;
    bodies_[i]->setWorldTransform(state.at[i]);
    bodies_[i]->setInterpolationWorldTransform(state.at[i]);
    bodies_[i]->setLinearVelocity(state.velocity[i]);
    bodies_[i]->setAngularVelocity(state.spin[i]);
  }
}

void Game::step(bool check) {
  if (before_step_) before_step_(steps_);
  ++steps_;
  world_->after_pairs = [this, check] {
    pairs_ = std::uint64_t(pair_cache().getNumOverlappingPairs());
    if (check && difference_.empty()) check_pairs();
  };
  world_->actions_ms = 0;
  const double start = now_ms();
  world_->stepSimulation(time_step, 1, time_step);
  const double stepped = now_ms();
  if (cast_rays_) cast_rays_();
  times_[Part::rays] = now_ms() - stepped;
  times_[Part::whole] = stepped - start - world_->check_ms;
  times_[Part::update] = world_->update_ms + world_->actions_ms;
  times_[Part::pairs] = world_->pairs_ms;
  times_[Part::sum] = times_[Part::update] + times_[Part::pairs];
  times_[Part::dispatch] = world_->dispatch_ms;
  times_[Part::solve] = times_[Part::whole] - times_[Part::sum] - times_[Part::dispatch];
}

void Game::detect_only() {
  world_->updateAabbs();
  world_->computeOverlappingPairs();
}

std::size_t Game::objects() const {
  return objects_.size();
}

/// What is held must be what there must be, once those are left out whose boxes are apart.
void Game::check_pairs() {
  std::vector<btBroadphaseProxy*> proxies;
  for (const auto& object : objects_)
    if (object->getBroadphaseHandle()) proxies.push_back(object->getBroadphaseHandle());
  const btOverlappingPairCache& cache = *broadphase_->getOverlappingPairCache();
  std::vector<Ids> held;
  const int count = cache.getNumOverlappingPairs();
  const btBroadphasePair* const array = count == 0 ? nullptr : cache.getOverlappingPairArrayPtr();
  for (int i = 0; i < count; ++i)
    if (touch(*array[i].m_pProxy0, *array[i].m_pProxy1))
      held.push_back(ids_of(*array[i].m_pProxy0, *array[i].m_pProxy1));
  std::sort(held.begin(), held.end());
  const std::vector<Ids> expected = expected_pairs(proxies, cache);
  if (held != expected)
    difference_ = fmt::format("step {}: {} pairs are held, {} are expected", steps_, held.size(), expected.size());
}

}  // namespace boxstream::bench
