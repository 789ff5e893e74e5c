// SPDX-License-Identifier: MIT
// An arm above a table with things on it, checked the way motion planners do it: a manager for the world that stays, a
// new one for the robot in each state.
#include <fcl/fcl.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

using Object = fcl::CollisionObjectd;
using Manager = fcl::DynamicAABBTreeCollisionManagerd;

struct Link {
  int number;  // neighbours may touch
};

struct Check {
  std::size_t contacts = 0;
  double distance = 1e9;
};

bool are_neighbours(const Object* a, const Object* b) {
  const auto* x = static_cast<const Link*>(a->getUserData());
  const auto* y = static_cast<const Link*>(b->getUserData());
  return x != nullptr && y != nullptr && std::abs(x->number - y->number) <= 1;
}

bool on_contact(Object* a, Object* b, void* data) {
  if (are_neighbours(a, b)) return false;
  fcl::CollisionResultd result;
  static_cast<Check*>(data)->contacts += fcl::collide(a, b, fcl::CollisionRequestd(), result) > 0;
  return false;
}

bool on_distance(Object* a, Object* b, void* data, double& dist) {
  Check& check = *static_cast<Check*>(data);
  if (are_neighbours(a, b)) return false;
  fcl::DistanceResultd result;
  fcl::distance(a, b, fcl::DistanceRequestd(), result);
  check.distance = std::min(check.distance, std::max(0.0, result.min_distance));
  dist = check.distance;  // nothing further away is of interest
  return dist <= 0;
}

int main() {
  // The world: a table and a grid of things.
  std::vector<std::unique_ptr<Object>> world;
  world.push_back(std::make_unique<Object>(std::make_shared<fcl::Boxd>(3, 3, 0.1)));
  for (int i = 0; i < 100; ++i) {
    const fcl::Vector3d at(0.28 * (i % 10) - 1.26, 0.28 * (i / 10) - 1.26, 0.15);
    std::shared_ptr<fcl::CollisionGeometryd> shape;
    if (i % 3 == 0) shape = std::make_shared<fcl::Boxd>(0.1, 0.1, 0.2);
    if (i % 3 == 1) shape = std::make_shared<fcl::Cylinderd>(0.05, 0.2);
    if (i % 3 == 2) shape = std::make_shared<fcl::Sphered>(0.1);
    world.push_back(std::make_unique<Object>(shape, fcl::Matrix3d::Identity(), at));
  }
  std::vector<Object*> world_objects;
  for (const auto& object : world) {
    object->computeAABB();
    world_objects.push_back(object.get());
  }
  Manager world_manager;
  world_manager.registerObjects(world_objects);

  // The robot: six links, one after the other.
  std::vector<std::unique_ptr<Object>> robot;
  std::vector<Link> links(6);
  for (int i = 0; i < 6; ++i) {
    links[i].number = i;
    robot.push_back(std::make_unique<Object>(std::make_shared<fcl::Capsuled>(0.04, 0.3)));
    robot.back()->setUserData(&links[i]);
  }

  for (int state = 0; state < 12; ++state) {
    fcl::Transform3d frame = fcl::Transform3d::Identity();
    frame.translation().z() = 0.1;
    frame.rotate(fcl::AngleAxisd(0.5 * state, fcl::Vector3d::UnitZ()));
    Manager robot_manager;
    for (const auto& link : robot) {
      frame.rotate(fcl::AngleAxisd(0.2 + 0.1 * state, fcl::Vector3d::UnitY()));
      frame.translate(fcl::Vector3d(0, 0, 0.2));
      link->setTransform(frame);
      link->computeAABB();
      frame.translate(fcl::Vector3d(0, 0, 0.2));
      robot_manager.registerObject(link.get());
    }
    Check self, against_world;
    robot_manager.collide(&self, on_contact);
    robot_manager.distance(&self, on_distance);
    for (const auto& link : robot) world_manager.collide(link.get(), &against_world, on_contact);
    world_manager.distance(&robot_manager, &against_world, on_distance);
    std::printf("state %2d: %zu contacts with itself, %.4f apart; %zu with the world, %.4f apart\n", state,
                self.contacts, self.distance, against_world.contacts, against_world.distance);
  }
}
