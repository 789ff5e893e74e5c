// SPDX-License-Identifier: MIT
// Calls Bullet as Siconos does: a btCollisionWorld on the heap, multipoint iterations, bodies that follow paths, one
// performDiscreteCollisionDetection a step, and then all points of all manifolds; objects come and go.
// siconos_way BODIES STEPS: prints a sum over the touching points of each pair.
#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <set>
#include <utility>
#include <vector>

#include "broadphase.hpp"

namespace {

class Manager {
 public:
  explicit Manager(int bodies) {
    configuration_->setConvexConvexMultipointIterations(3, 3);
    configuration_->setPlaneConvexMultipointIterations(3, 3);
    add(ground_.get(), btVector3(0, 0, -0.25F));
    for (int i = 0; i < bodies; ++i)
      add(i % 2 == 0 ? static_cast<btCollisionShape*>(cube_.get()) : ball_.get(), place(i, 0));
  }
  ~Manager() {
    for (const auto& each : objects_) world_->removeCollisionObject(each.get());
  }

  void step(int now) {
    for (int i = 1; i < int(objects_.size()); ++i)
      objects_[std::size_t(i)]->getWorldTransform().setOrigin(place(i - 1, now));
    if (now % 50 == 49 && objects_.size() > 2) {
      world_->removeCollisionObject(objects_.back().get());
      objects_.pop_back();
    }
    world_->performDiscreteCollisionDetection();
    std::set<std::pair<int, int>> touching;  // the order of manifolds is that of pairs
    for (int i = 0; i < dispatcher_->getNumManifolds(); ++i) {
      btPersistentManifold& manifold = *dispatcher_->getManifoldByIndexInternal(i);
      const int a = manifold.getBody0()->getUserIndex(), b = manifold.getBody1()->getUserIndex();
      for (int k = 0; k < manifold.getNumContacts(); ++k)
        if (manifold.getContactPoint(k).getDistance() < 0) touching.emplace(std::min(a, b), std::max(a, b));
      // Points are kept as long as a pair is, which Bullet's broad-phase keeps longer, and count while bodies slide
      // apart.
      manifold.clearManifold();
    }
    for (const auto& [a, b] : touching) sum_ = (sum_ * 31 + std::size_t(a) * 1009 + std::size_t(b)) % 1000000007;
    pairs_ += touching.size();
  }

  void print() const { std::printf("%zu %zu\n", pairs_, sum_); }

 private:
  static btVector3 place(int i, int now) {
    const float t = 0.01F * float(now) + 0.7F * float(i);
    return {4 * std::sin(t), 4 * std::cos(1.3F * t), 0.6F + 0.5F * std::sin(2.1F * t)};
  }
  void add(btCollisionShape* shape, const btVector3& at) {
    objects_.push_back(std::make_unique<btCollisionObject>());
    btCollisionObject& object = *objects_.back();
    object.setCollisionShape(shape);
    object.setUserIndex(int(objects_.size()));
    object.setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
    world_->addCollisionObject(&object);
  }

  std::unique_ptr<btDefaultCollisionConfiguration> configuration_ = std::make_unique<btDefaultCollisionConfiguration>();
  std::unique_ptr<btCollisionDispatcher> dispatcher_ = std::make_unique<btCollisionDispatcher>(configuration_.get());
  std::unique_ptr<Broadphase> broadphase_ = std::make_unique<Broadphase>();
  std::unique_ptr<btCollisionWorld> world_ =
      std::make_unique<btCollisionWorld>(dispatcher_.get(), broadphase_.get(), configuration_.get());
  std::unique_ptr<btBoxShape> ground_ = std::make_unique<btBoxShape>(btVector3(15, 15, 0.25F));
  std::unique_ptr<btBoxShape> cube_ = std::make_unique<btBoxShape>(btVector3(0.4F, 0.3F, 0.5F));
  std::unique_ptr<btSphereShape> ball_ = std::make_unique<btSphereShape>(0.5F);
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::size_t pairs_ = 0, sum_ = 0;
};

}  // namespace

int main(int, char** arguments) {
  Manager manager(std::atoi(arguments[1]));
  for (int now = 0; now < std::atoi(arguments[2]); ++now) manager.step(now);
  manager.print();
}
