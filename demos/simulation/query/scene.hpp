// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "formats/scene_model/scene.hpp"

/// Scenes of queries in FCL's terms: groups of objects, each in a manager of its own, moved along fixed courses, and
/// the queries after each step. Plain data, checked, nothing of an engine in it. Metres and steps; y is up.
namespace boxstream::query {

using scenes::Vec3;

using ShapeValue = std::variant<scenes::BoxShape, scenes::SphereShape, scenes::CapsuleShape, scenes::CylinderShape,
                                scenes::ConeShape, scenes::MeshShape>;

struct MixEntry {
  std::size_t shape = 0;
  double weight = 1;
};

/// `count` bodies at the points of a Halton sequence in a box, which may be shaken: each then swings about its place,
/// with a phase of its own.
struct Scatter {
  static constexpr const char* kind = "scatter";
  int count = 0;
  Vec3 origin{};  // middle of the floor of the box
  Vec3 size{};
  bool turned = false;  // random rotations
  double shake = 0;     // how far it swings, in metres
  double degrees = 0;   // and turns
  std::vector<MixEntry> mix;
};

/// A floor and four walls.
struct Bin {
  static constexpr const char* kind = "bin";
  Vec3 origin{};  // middle of the floor
  Vec3 size{};    // of the room inside
  double thickness = 0.02;
};

/// A palm with fingers that point down, led from waypoint to waypoint and back, turning, opening and closing.
struct Gripper {
  static constexpr const char* kind = "gripper";
  int fingers = 3;
  double size = 0.1;  // of the palm
  std::vector<Vec3> path;
  int leg = 30;  // steps from one waypoint to the next
  double degrees = 1;
};

/// A chain of capsules from a base upwards whose joints swing, each at a pace of its own.
struct Arm {
  static constexpr const char* kind = "arm";
  Vec3 base{};
  int links = 7;
  double length = 0.3;
  double radius = 0.05;
  double degrees = 60;  // a joint's largest angle
  int period = 200;     // steps
};

/// Lorries in lanes along x, one behind the other on a ring road unrolled: each has its own pace, and they come close.
struct Convoy {
  static constexpr const char* kind = "convoy";
  int vehicles = 10;
  int lanes = 2;
  double lane_width = 3.5;
  double gap = 8;      // from the end of one to the next, at the start
  double speed = 0.4;  // metres a step
  double sway = 3;     // metres that each drifts to and fro within its column
};

using Actor = std::variant<Scatter, Bin, Gripper, Arm, Convoy>;

struct Group {
  std::string name;
  std::vector<Actor> actors;
  double margin = 0;  // boxes reach this much farther together: each grows by half of it
};

enum class Kind {
  collide,   ///< which pairs touch, and their contacts
  first,     ///< whether any pair touches: stops at the first
  distance,  ///< the least distance
  within,    ///< which pairs are closer than `limit`: the groups' margins must reach that far
};

struct Query {
  std::string name;
  Kind kind = Kind::collide;
  std::size_t a = 0;             // index of a group
  std::optional<std::size_t> b;  // none: pairs within `a`
  bool each_object = false;      // objects of `a` one by one in place of manager against manager
  double limit = 0;
  int contacts = 10;  // at most, for each pair
};

struct QueryScene {
  std::string file;  // where it came from, for messages
  scenes::Meta meta;
  int steps = 100;
  std::uint64_t seed = 1;
  std::vector<ShapeValue> shapes;
  std::vector<Group> groups;
  std::vector<Query> queries;
};

/// Reads a scene file. Throws scenes::SceneError.
QueryScene load_query_scene(const std::string& path);
/// The same from text; `name` stands for the file in messages.
QueryScene parse_query_scene(const std::string& text, const std::string& name);

/// About `factor` times as many scattered bodies and vehicles, with densities as they were. 0 < factor.
QueryScene scaled(QueryScene scene, double factor);

}  // namespace boxstream::query
