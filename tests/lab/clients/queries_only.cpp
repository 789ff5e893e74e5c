// SPDX-License-Identifier: MIT
// A world that is never asked for pairs, as games with controllers of their own have: houses that stand, people who are
// moved by updateSingleAabb, and in each frame a sweep, a ray and a contact test of each.
// queries_only HOUSES PEOPLE FRAMES: prints how many were hit, and a sum over what was hit and where.
#include <btBulletCollisionCommon.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

#include "broadphase.hpp"

namespace {

struct Contacts : btCollisionWorld::ContactResultCallback {
  const btCollisionObject* self = nullptr;
  long others = 0;

  btScalar addSingleResult(btManifoldPoint& point, const btCollisionObjectWrapper* a, int, int,
                           const btCollisionObjectWrapper* b, int, int) override {
    const btCollisionObject* const other =
        a->getCollisionObject() == self ? b->getCollisionObject() : a->getCollisionObject();
    if (point.getDistance() < 0) others += other->getUserIndex();
    return 0;
  }
};

class Town {
 public:
  Town(int houses, int people) : side_(4 * std::sqrt(float(houses))) {
    world_.setForceUpdateAllAabbs(false);
    for (int i = 0; i < houses; ++i) add(&house_);
    for (int i = 0; i < people; ++i) people_.push_back(add(&person_));
  }
  ~Town() {
    for (const auto& each : objects_) world_.removeCollisionObject(each.get());
  }

  void frame() {
    for (btCollisionObject* const each : people_) {
      each->getWorldTransform().getOrigin() += btVector3(uniform() - 0.5F, 0, uniform() - 0.5F);
      world_.updateSingleAabb(each);
    }
    for (btCollisionObject* const each : people_) {
      const btTransform from = each->getWorldTransform();
      btTransform to = from;
      to.getOrigin() += btVector3(1, -0.5F, 0.3F);
      btCollisionWorld::ClosestConvexResultCallback sweep(from.getOrigin(), to.getOrigin());
      world_.convexSweepTest(&ball_, from, to, sweep);
      btCollisionWorld::ClosestRayResultCallback ray(from.getOrigin(), from.getOrigin() + btVector3(30, 0, 5));
      world_.rayTest(ray.m_rayFromWorld, ray.m_rayToWorld, ray);
      Contacts contacts;
      contacts.self = each;
      world_.contactTest(each, contacts);
      hits_ += sweep.hasHit() + ray.hasHit();
      sum_ += double(sweep.m_closestHitFraction) + double(ray.m_closestHitFraction) + double(contacts.others);
    }
  }

  void print() const { std::printf("%ld %.17g\n", hits_, sum_); }

 private:
  float uniform() { return std::uniform_real_distribution<float>(0, 1)(random_); }
  btCollisionObject* add(btCollisionShape* shape) {
    objects_.push_back(std::make_unique<btCollisionObject>());
    btCollisionObject& object = *objects_.back();
    object.setCollisionShape(shape);
    object.setUserIndex(int(objects_.size()));
    btTransform place = btTransform::getIdentity();
    place.setOrigin(btVector3(uniform() * side_, 1, uniform() * side_));
    object.setWorldTransform(place);
    world_.addCollisionObject(&object);
    return &object;
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  Broadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  btBoxShape house_{btVector3(2, 2, 2)};
  btCapsuleShape person_{0.3F, 1};
  btSphereShape ball_{0.3F};
  std::mt19937 random_{5};
  float side_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::vector<btCollisionObject*> people_;
  long hits_ = 0;
  double sum_ = 0;
};

}  // namespace

int main(int, char** arguments) {
  Town town(std::atoi(arguments[1]), std::atoi(arguments[2]));
  for (int frame = std::atoi(arguments[3]); frame > 0; --frame) town.frame();
  town.print();
}
