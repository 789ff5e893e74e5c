// SPDX-License-Identifier: MIT
// A world that is only asked, from four threads at once, as servers of games ask it: on boxstream they find what one
// thread finds. With the argument `dbvt` the same is asked of btDbvtBroadphase, whose ray tests share one stack unless
// Bullet was built with BT_THREADSAFE: they lose hits, now and then, or worse.
#include <boxstream/bullet.hpp>

#include <btBulletCollisionCommon.h>

#include <cstdio>
#include <cstring>
#include <memory>
#include <random>
#include <thread>
#include <vector>

namespace {

constexpr int houses = 3000, rays = 40000;

class World {
 public:
  explicit World(btBroadphaseInterface& broadphase) : world_(&dispatcher_, &broadphase, &configuration_) {
    for (int i = 0; i < houses; ++i) {
      objects_.push_back(std::make_unique<btCollisionObject>());
      objects_.back()->setCollisionShape(&house_);
      objects_.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), anywhere()));
      world_.addCollisionObject(objects_.back().get());
    }
    for (int i = 0; i < 2 * rays; ++i) ends_.push_back(anywhere());
  }
  ~World() {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  int hits(int threads) const {
    std::vector<int> found(threads, 0);
    const auto work = [&](int which) {
      int count = 0;
      for (int i = which; i < rays; i += threads) {
        btCollisionWorld::ClosestRayResultCallback hit(ends_[2 * i], ends_[2 * i + 1]);
        world_.rayTest(hit.m_rayFromWorld, hit.m_rayToWorld, hit);
        count += hit.hasHit();
      }
      found[which] = count;
    };
    std::vector<std::thread> others;
    for (int which = 1; which < threads; ++which) others.emplace_back(work, which);
    work(0);
    for (std::thread& other : others) other.join();
    int all = 0;
    for (const int count : found) all += count;
    return all;
  }

 private:
  btVector3 anywhere() {
    std::uniform_real_distribution<float> at(0, 400);
    const float x = at(random_), y = at(random_) / 40, z = at(random_);
    return {x, y, z};
  }

  std::mt19937 random_{3};
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btCollisionWorld world_;
  btBoxShape house_{btVector3(2, 2, 2)};
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  std::vector<btVector3> ends_;
};

}  // namespace

int main(int count, char** arguments) {
  std::unique_ptr<btBroadphaseInterface> broadphase = std::make_unique<boxstream::bullet::Broadphase>();
  if (count > 1 && std::strcmp(arguments[1], "dbvt") == 0) broadphase = std::make_unique<btDbvtBroadphase>();
  const World world(*broadphase);
  const int right = world.hits(1);
  int wrong = 0;
  for (int again = 0; again < 5; ++again) wrong += world.hits(4) != right;
  std::printf("%d rays, 5 times on four threads: %d times other hits than on one\n", rays, wrong);
}
