// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "formats/scene_model/bodies.hpp"
#include "formats/scene_model/checks.hpp"
#include "formats/scene_model/fields.hpp"
#include "formats/scene_model/generators.hpp"
#include "formats/scene_model/joints.hpp"
#include "formats/scene_model/settings.hpp"
#include "formats/scene_model/shapes.hpp"
#include "formats/scene_model/values.hpp"

namespace boxstream::scenes {

/// Rays that are cast after each step, from one point to points evenly spaced on a circle around the vertical through
/// it; the circle turns from step to step.
struct RayFan {
  static constexpr const char* kind = "rays";
  int count = 1;
  Vec3 from{};
  double radius = 1;
  double drop = 1;     // how far the circle is below the point
  double degrees = 1;  // of turning, in a step
};

/// Asks after each step for all boxes that touch one.
struct BoxQuery {
  static constexpr const char* kind = "box";
  Bounds bounds;
};

/// Asks after each step for all contacts of one body (Bullet's contactTest).
struct ContactQuery {
  static constexpr const char* kind = "contact";
  std::size_t body = 0;  // index of a body
};

using Query = std::variant<RayFan, BoxQuery, ContactQuery>;

struct ClothSoft {
  static constexpr const char* kind = "cloth";
  std::array<Vec3, 4> corners;  // 00, 10, 01, 11
  std::array<int, 2> resolution;
  int pinned = 0;  // bit per corner, in the order above
};
struct BallSoft {
  static constexpr const char* kind = "ball";
  Vec3 centre;
  double radius;
  int resolution;
  double pressure;
};

struct SoftBody {
  std::string name;
  double mass = 1;  // whole
  double stiffness = 0.9;
  double damping = 0.005;
  double friction = 0.5;
  double margin = 0.05;
  int iterations = 4;
  std::variant<ClothSoft, BallSoft> value;
};

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

/// A number for each kind of thing in a scene.
template <class Count>
struct Counts {
  Count objects{};  // everything the broad-phase sees
  Count bodies{};   // rigid, fixed ones included
  Count fixed{}, kinematic{}, dynamic{};
  Count joints{}, sensors{}, characters{}, soft_bodies{}, soft_nodes{};
  std::array<Count, std::variant_size_v<ShapeValue>> shapes{};  // bodies by kind of shape
};

/// What a scene says about itself; every number is checked against what was built.
struct Expect : Counts<std::optional<std::uint64_t>> {
  std::optional<double> size_ratio;  // largest over smallest box diagonal of the dynamic bodies, at least
};

/// How many of what was built.
struct Census : Counts<std::uint64_t> {
  double size_ratio = 0;  // largest over smallest box diagonal of the dynamic bodies
};

/// Calls visit(name, a's count, b's count) for each kind; names are those of a scene's "expect".
template <class A, class B, class Visit>
void for_each_count(A& a, B& b, const Visit& visit) {
  visit("objects", a.objects, b.objects);
  visit("bodies", a.bodies, b.bodies);
  visit("static", a.fixed, b.fixed);
  visit("kinematic", a.kinematic, b.kinematic);
  visit("dynamic", a.dynamic, b.dynamic);
  visit("joints", a.joints, b.joints);
  visit("sensors", a.sensors, b.sensors);
  visit("characters", a.characters, b.characters);
  visit("soft_bodies", a.soft_bodies, b.soft_bodies);
  visit("soft_nodes", a.soft_nodes, b.soft_nodes);
  const auto names = []<class... S>(const std::variant<S...>*) { return std::array{S::plural...}; };
  const auto plurals = names(static_cast<const ShapeValue*>(nullptr));
  for (std::size_t i = 0; i < plurals.size(); ++i) visit(plurals[i], a.shapes[i], b.shapes[i]);
}

/// A scene as its file states it: plain data, checked, names resolved to indices, nothing of an engine in it.
/// Units are SI; y is up. Docs of each field: demos/scenes/README.md.
struct Scene {
  std::string file;                    // where it came from, for messages
  std::vector<std::string> old_words;  // of its file, each with what it is called now: `"rain" is "respawn" now`
  Meta meta;
  Time time;
  WorldSettings world;
  Solver solver;
  BroadphaseSettings broadphase;
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<Generator> generators;
  std::vector<Joint> joints;
  std::vector<Sensor> sensors;
  std::vector<Character> characters;
  std::vector<SoftBody> soft_bodies;
  std::vector<Vehicle> vehicles;
  std::vector<Field> fields;
  std::vector<Query> queries;
  std::vector<std::array<std::size_t, 2>> exclusions;  // pairs of bodies that pass through each other
  EffectWishes effects;
  std::vector<Check> checks;
  Outputs outputs;
  Expect expect;
};

/// The same scene with about `factor` (> 0) times as many generated bodies: counts scale with `factor`, rooms and
/// lattices with its cube root, walls, grounds, groups of pyramids and cloths with its square root, so that densities
/// stay. Single bodies, chains and sensors stay as they are, and grids that say so; `expect` is dropped because it
/// speaks of the full size. Where the world is self-similar, places, speeds and gravity scale like rooms.
///
/// Throws std::invalid_argument: the factor is not positive, or there would be more than `most_scaled_bodies`.
Scene scaled(const Scene& scene, double factor);

}  // namespace boxstream::scenes
