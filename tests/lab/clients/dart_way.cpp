// SPDX-License-Identifier: MIT
// Calls FCL as DART does: a manager per group, boxes computed anew and update() of all before each query, contacts by
// FCL's collide, distances that begin with a bound; also one group against another.
// dart_way BODIES STEPS: prints a sum over what touches, and the least distance of the groups.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

// The two lines that change in a program with FCL.
#ifdef SWAPPED
#include <boxstream/fcl.hpp>
using Manager = boxstream::fcl::CollisionManager<double>;
#else
using Manager = fcl::DynamicAABBTreeCollisionManager<double>;
#endif

namespace {

using Object = fcl::CollisionObject<double>;

int number(const Object* object) {
  return *static_cast<const int*>(object->getUserData());
}

using Touching = std::vector<std::pair<int, int>>;

bool collect(Object* a, Object* b, void* data) {
  fcl::CollisionRequest<double> request(4, true);
  fcl::CollisionResult<double> result;
  if (fcl::collide(a, b, request, result) > 0)
    static_cast<Touching*>(data)->emplace_back(std::minmax(number(a), number(b)));
  return false;
}

bool nearest(Object* a, Object* b, void* data, double& least) {
  fcl::DistanceRequest<double> request;
  fcl::DistanceResult<double> result;
  least = *static_cast<double*>(data);
  *static_cast<double*>(data) = std::min(least, fcl::distance(a, b, request, result));
  least = *static_cast<double*>(data);
  return least <= 0;
}

struct Group {
  Manager manager;
  std::vector<std::unique_ptr<Object>> objects;

  void update() {
    for (const auto& each : objects) each->computeAABB();
    manager.update();
  }
};

}  // namespace

int main(int, char** arguments) {
  const int bodies = std::atoi(arguments[1]);
  std::vector<int> numbers;
  for (int i = 0; i < bodies; ++i) numbers.push_back(i);
  const auto box = std::make_shared<fcl::Box<double>>(0.7, 0.5, 0.9);
  const auto ball = std::make_shared<fcl::Sphere<double>>(0.4);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(-4, 4);
  Group robot, world;
  for (int i = 0; i < bodies; ++i) {
    Group& group = i % 4 == 0 ? robot : world;
    group.objects.push_back(i % 2 == 0 ? std::make_unique<Object>(box) : std::make_unique<Object>(ball));
    group.objects.back()->setUserData(&numbers[std::size_t(i)]);
    group.objects.back()->setTranslation(
        fcl::Vector3<double>(in(random) + (i % 4 == 0 ? 6 : 0), in(random), in(random)));
    group.manager.registerObject(group.objects.back().get());
  }
  std::size_t pairs = 0, sum = 0;
  double distances = 0;
  for (int step = std::atoi(arguments[2]); step > 0; --step) {
    for (Group* const group : {&robot, &world}) {
      for (const auto& each : group->objects) {
        const fcl::Vector3<double> way(0.02 * in(random), 0.02 * in(random), 0.02 * in(random));
        each->setTranslation(each->getTranslation() + way);
      }
      group->update();
    }
    Touching touching;
    world.manager.collide(&touching, collect);
    robot.manager.collide(&world.manager, &touching, collect);
    std::sort(touching.begin(), touching.end());
    for (const auto& [a, b] : touching) sum = (sum * 31 + std::size_t(a) * 1009 + std::size_t(b)) % 1000000007;
    pairs += touching.size();
    double least = std::numeric_limits<double>::max();
    robot.manager.distance(&world.manager, &least, nearest);
    distances += std::max(least, 0.0);
  }
  std::printf("%zu %zu %.12g\n", pairs, sum, distances);
}
