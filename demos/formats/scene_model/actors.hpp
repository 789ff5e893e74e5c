// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// Counts what is inside; touches nothing.
struct Sensor {
  std::string name;
  Vec3 half_extents{};
  Vec3 position{};
};

/// A capsule that walks from waypoint to waypoint, round and round, climbs steps and pushes what it meets.
struct Character {
  std::string name;
  double radius = 0.3;
  double height = 1.0;  // of the capsule's cylinder
  double step = 0.3;
  double speed = 1.5;
  double push = 0;  // force on dynamic bodies in its way, newton
  double jump_speed = 4;
  int jump_every = 0;  // steps; 0: never
  std::vector<Vec3> path;
};

struct Wheel {
  Vec3 at{};  // where its suspension is fixed, in the chassis' coordinates
  double radius = 0.3;
  bool steered = false;
  bool driven = false;
};

/// A raycast vehicle: a dynamic body on wheels that are rays. Drives towards +z of its chassis.
struct Vehicle {
  std::size_t chassis = 0;  // index of a body
  std::vector<Wheel> wheels;
  double suspension = 0.4;  // metres at rest
  double stiffness = 20;    // of the suspension, 1/s^2
  double grip = 1.5;        // friction of the tyres
  double engine = 0;        // N on each driven wheel
  double brake = 0;         // N s on each wheel, in a step
  double steer = 0;         // radians of the steered wheels, to the left
};

}  // namespace boxstream::scenes
