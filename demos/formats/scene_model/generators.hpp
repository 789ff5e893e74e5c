// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "formats/scene_model/bodies.hpp"
#include "formats/scene_model/joints.hpp"
#include "formats/scene_model/scaling.hpp"
#include "formats/scene_model/shapes.hpp"

namespace boxstream::scenes {

struct Expanded;
class Random;

// Each kind of generator has the name of its "type" and
//   most_bodies()     as many bodies as it makes, or a few more;
//   scale(by)         makes it larger, as `scaled` of scene.hpp says;
//   generate(r, out)  appends what it makes to `out`; the random numbers are for this generator alone.

inline std::size_t area(const std::array<int, 2>& columns) {
  return static_cast<std::size_t>(columns[0]) * static_cast<std::size_t>(columns[1]);
}

/// One kind of body among those that a grid deals out.
struct MixEntry {
  BodyTraits traits;
  double weight = 1;
  std::array<double, 2> scale{1, 1};  // sizes are drawn log-uniformly from this range
};

/// `count` bodies on a lattice, layer after layer upwards, drawn from a mix. They may be fixed or kinematic.
struct GridGenerator {
  static constexpr const char* kind = "grid";
  int count = 0;
  std::array<int, 2> columns{1, 1};  // along x and z
  Vec3 spacing{};
  Vec3 origin{};        // centre of the lowest layer
  double jitter = 0;    // largest offset per axis, in metres
  bool turned = false;  // random rotations
  double vortex = 0;    // initial speed around the vertical through the origin
  double speed = 0;     // largest size of a random initial velocity, uniform in a ball
  bool scales = true;   // false: as many in a scaled scene
  std::vector<MixEntry> mix;

  std::size_t most_bodies() const { return static_cast<std::size_t>(count); }
  void scale(const Scaling& by) {
    if (!scales) return;
    Scaling::columns(columns, is_ground() ? by.face : by.side);
    count = Scaling::times(count, by.factor);
    if (by.self_similar) vortex *= by.side, speed *= by.side;
  }
  void generate(Random& random, Expanded& out) const;

 private:
  bool is_ground() const {
    const auto moves = [](const MixEntry& entry) { return entry.traits.type == BodyType::dynamic; };
    return count <= columns[0] * columns[1] && std::none_of(mix.begin(), mix.end(), moves);
  }
};

/// Where `count` bodies start independently of each other: places are uniform in a ball, and so are velocities.
/// Some may overlap.
struct BallStart {
  int count = 0;
  Vec3 centre{};
  double radius = 1;
  double speed = 0;  // radius of the ball of velocities, m/s

  void scale(const Scaling& by) {
    count = Scaling::times(count, by.factor);
    radius *= by.side;
    if (!by.self_similar) return;
    by.room(centre);
    speed *= by.side;
  }
};

/// Bodies drawn from a mix that start in a ball (Broadmark's cubes and spheres).
struct BallRandomGenerator {
  static constexpr const char* kind = "ball_random";
  BallStart start;
  bool turned = false;  // random rotations
  std::vector<MixEntry> mix;

  std::size_t most_bodies() const { return static_cast<std::size_t>(start.count); }
  void scale(const Scaling& by) { start.scale(by); }
  void generate(Random& random, Expanded& out) const;
};

/// Broadmark's assorted boxes, which start in a ball, none of them turned. In every 80, in this order: 4 small cubes, 4
/// large ones, 5 bars, 3 planks, 3 slabs, and 61 boxes with sides drawn from (0.08, 1.53).
struct Assorted80Generator {
  static constexpr const char* kind = "assorted80";
  BallStart start;
  BodyTraits unit;  // its shape is a box, in whose sides the boxes are measured

  std::size_t most_bodies() const { return static_cast<std::size_t>(start.count); }
  void scale(const Scaling& by) { start.scale(by); }
  void generate(Random& random, Expanded& out) const;
};

/// A wall of bricks along x in running bond, with half bricks at the ends of every second row.
struct WallGenerator {
  static constexpr const char* kind = "wall";
  BodyTraits brick;  // its shape is a box; x is the length
  int columns = 1;
  int rows = 1;
  Vec3 origin{};  // middle of the foot
  double gap = 0;

  std::size_t most_bodies() const { return static_cast<std::size_t>(columns + 1) * static_cast<std::size_t>(rows); }
  void scale(const Scaling& by) {
    columns = Scaling::times(columns, by.face);
    rows = Scaling::times(rows, by.face);
  }
  void generate(Random& random, Expanded& out) const;
};

/// Layers of upright bricks, each with one less to a side than the one below.
struct PyramidGenerator {
  static constexpr const char* kind = "pyramid";
  BodyTraits brick;  // its shape is a box
  int levels = 1;
  bool flat = false;                // one brick deep: a triangular wall
  Vec3 origin{};                    // middle of the foot
  double degrees = 0;               // how far it is turned about the vertical
  double gap = 0;                   // between bricks of a layer
  std::array<int, 2> repeat{1, 1};  // along x and z, centred on the origin
  std::array<double, 2> spacing{};  // from one to the next

  std::size_t most_bodies() const {
    const auto n = static_cast<std::size_t>(levels);
    return (flat ? n * (n + 1) / 2 : n * (n + 1) * (2 * n + 1) / 6) * area(repeat);
  }
  void scale(const Scaling& by) {
    if (repeat != std::array<int, 2>{1, 1}) {
      for (int& n : repeat) n = Scaling::times(n, by.face);
    } else {
      levels = Scaling::times(levels, flat ? by.face : by.side);
    }
  }
  void generate(Random& random, Expanded& out) const;
};

/// Rings of bricks, each turned by half a brick against the one below.
struct TowerGenerator {
  static constexpr const char* kind = "tower";
  BodyTraits brick;  // its shape is a box; x lies along the ring
  int levels = 1;
  int around = 3;  // bricks in a ring
  Vec3 origin{};   // middle of the foot
  double gap = 0;  // between inner edges of neighbours

  std::size_t most_bodies() const { return static_cast<std::size_t>(levels) * static_cast<std::size_t>(around); }
  void scale(const Scaling& by) { levels = Scaling::times(levels, by.factor); }
  void generate(Random& random, Expanded& out) const;
};

/// `count` bodies drawn from a mix at the points of a Halton sequence in a box: evenly, but with no pattern, and some
/// may overlap.
struct ScatterGenerator {
  static constexpr const char* kind = "scatter";
  int count = 0;
  Vec3 origin{};  // middle of the floor of the box
  Vec3 size{};
  bool turned = false;  // random rotations
  std::vector<MixEntry> mix;

  std::size_t most_bodies() const { return static_cast<std::size_t>(count); }
  void scale(const Scaling& by) {
    count = Scaling::times(count, by.factor);
    by.room(size);
  }
  void generate(Random& random, Expanded& out) const;
};

/// `count` bodies drawn from a mix that drop from a box: `at_once` of them every `every` steps, round and round. One
/// whose turn comes again is taken out of the world and put in anew, at another place of the box.
struct RespawnGenerator {
  static constexpr const char* kind = "respawn";
  int count = 0;
  int at_once = 1;
  int every = 1;
  Vec3 origin{};  // middle of the box
  Vec3 size{};
  Vec3 velocity{};
  bool turned = false;  // random rotations
  std::vector<MixEntry> mix;

  std::size_t most_bodies() const { return static_cast<std::size_t>(count); }
  void scale(const Scaling& by) {
    count = Scaling::times(count, by.factor);
    at_once = Scaling::times(at_once, by.factor);
    by.room(size);
    if (!by.self_similar) return;
    by.room(origin);
    by.room(velocity);
  }
  void generate(Random& random, Expanded& out) const;
};

/// Links from a fixed anchor towards a last body, each joined to the one before by a ball joint.
struct ChainGenerator {
  static constexpr const char* kind = "chain";
  BodyTraits link;  // a capsule or box whose y is the length
  BodyTraits end;
  int links = 1;
  Vec3 anchor{};
  Vec3 direction{0, -1, 0};
  double pitch = 0;       // distance between joints
  double end_offset = 0;  // from the last joint to the centre of the last body

  std::size_t most_bodies() const { return static_cast<std::size_t>(links) + 1; }
  void scale(const Scaling&) {}
  void generate(Random& random, Expanded& out) const;
};

/// Bodies on a lattice that hangs down from its top row, each joined to its neighbours by ball joints half way.
struct JointGridGenerator {
  static constexpr const char* kind = "joint_grid";
  BodyTraits node;
  std::array<int, 2> columns{1, 1};  // along x, and down
  std::array<double, 2> spacing{};
  Vec3 origin{};  // middle of the top row
  int held = 1;   // bodies in the middle of the top row that ball joints hold in the world

  std::size_t most_bodies() const { return area(columns); }
  void scale(const Scaling& by) {
    for (int& n : columns) n = Scaling::times(n, by.face);
    held = std::min(held, columns[0]);
  }
  void generate(Random& random, Expanded& out) const;
};

/// A drum that turns about the z axis, and in it paddles that take along what lies at the bottom; one kinematic body.
/// Two fixed boxes close its ends.
struct DrumGenerator {
  static constexpr const char* kind = "drum";
  Vec3 centre{};
  double radius = 1;  // of the room inside: of the circle that touches the staves
  double length = 1;  // along z
  double thickness = 0.1;
  int staves = 24;
  int paddles = 4;
  double depth = 0;  // how far paddles reach inwards
  double spin = 0;   // rad/s
  Material material;

  std::size_t most_bodies() const { return 3; }
  void scale(const Scaling& by) {
    radius *= by.side;
    length *= by.side;
    depth *= by.side;
  }
  void generate(Random& random, Expanded& out) const;
};

/// Ragdolls of eleven capsules and ten joints (cone-twist and hinge), on a lattice.
struct RagdollGenerator {
  static constexpr const char* kind = "ragdolls";
  int count = 0;
  std::array<int, 2> columns{1, 1};
  Vec3 spacing{};
  Vec3 origin{};
  double height = 1.8;
  double mass = 75;
  double spin = 0;  // largest initial spin, rad/s
  Material material;

  std::size_t most_bodies() const { return static_cast<std::size_t>(count) * 11; }
  void scale(const Scaling& by) {
    count = Scaling::times(count, by.factor);
    Scaling::columns(columns, by.side);
  }
  void generate(Random& random, Expanded& out) const;
};

/// A floor and four walls of fixed boxes, and a lid if wanted; `size` is the room inside.
struct ContainerGenerator {
  static constexpr const char* kind = "container";
  Vec3 floor{};  // middle of the floor
  Vec3 size{};
  double thickness = 1;
  bool lid = false;
  Material material;

  std::size_t most_bodies() const { return 6; }
  void scale(const Scaling& by) {
    by.room(size);
    if (!by.self_similar) return;
    by.room(floor);
    thickness *= by.side;
  }
  void generate(Random& random, Expanded& out) const;
};

/// What a file of another program holds, read when the scene was: its shapes, and bodies and joints that are already
/// where the scene has them. Indices are those of its own lists.
struct ImportGenerator {
  static constexpr const char* kind = "import";
  std::string file;
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<std::array<std::size_t, 2>> exclusions;
  std::vector<std::string> notes;  // a line for each thing of the file that the scene does not have

  std::size_t most_bodies() const { return bodies.size(); }
  void scale(const Scaling&) {}
  void generate(Random& random, Expanded& out) const;
};

using Generator =
    std::variant<GridGenerator, WallGenerator, ChainGenerator, RagdollGenerator, ContainerGenerator, PyramidGenerator,
                 TowerGenerator, ScatterGenerator, RespawnGenerator, BallRandomGenerator, Assorted80Generator,
                 JointGridGenerator, DrumGenerator, ImportGenerator>;

inline std::size_t most_bodies(const Generator& generator) {
  return std::visit([](const auto& each) { return each.most_bodies(); }, generator);
}

}  // namespace boxstream::scenes
