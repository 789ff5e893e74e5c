// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "formats/scene_model/bodies.hpp"
#include "formats/scene_model/joints.hpp"
#include "formats/scene_model/shapes.hpp"

namespace boxstream::scenes {

/// One kind of body among those that a grid deals out.
struct MixEntry {
  BodyTraits traits;
  double weight = 1;
  std::array<double, 2> scale{1, 1};  // sizes are drawn log-uniformly from this range
};

/// `count` bodies on a lattice, layer after layer upwards, drawn from a mix. They may be fixed or kinematic.
struct GridGenerator {
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
};

/// Where `count` bodies start that know nothing of each other: places are uniform in a ball, and so are velocities.
/// Some may overlap.
struct BallStart {
  int count = 0;
  Vec3 centre{};
  double radius = 1;
  double speed = 0;  // radius of the ball of velocities, m/s
};

/// Bodies drawn from a mix that start in a ball (Broadmark's cubes and spheres).
struct BallRandomGenerator {
  BallStart start;
  bool turned = false;  // random rotations
  std::vector<MixEntry> mix;
};

/// Broadmark's assorted boxes, which start in a ball, none of them turned. In every 80, in this order: 4 small cubes, 4
/// large ones, 5 bars, 3 planks, 3 slabs, and 61 boxes with sides drawn from (0.08, 1.53).
struct Assorted80Generator {
  BallStart start;
  BodyTraits unit;  // its shape is a box, in whose sides the boxes are measured
};

/// A wall of bricks along x in running bond, with half bricks at the ends of every second row.
struct WallGenerator {
  BodyTraits brick;  // its shape is a box; x is the length
  int columns = 1;
  int rows = 1;
  Vec3 origin{};  // middle of the foot
  double gap = 0;
};

/// Layers of upright bricks, each with one less to a side than the one below.
struct PyramidGenerator {
  BodyTraits brick;  // its shape is a box
  int levels = 1;
  bool flat = false;                // one brick deep: a triangular wall
  Vec3 origin{};                    // middle of the foot
  double degrees = 0;               // how far it is turned about the vertical
  double gap = 0;                   // between bricks of a layer
  std::array<int, 2> repeat{1, 1};  // along x and z, centred on the origin
  std::array<double, 2> spacing{};  // from one to the next
};

/// Rings of bricks, each turned by half a brick against the one below.
struct TowerGenerator {
  BodyTraits brick;  // its shape is a box; x lies along the ring
  int levels = 1;
  int around = 3;  // bricks in a ring
  Vec3 origin{};   // middle of the foot
  double gap = 0;  // between inner edges of neighbours
};

/// `count` bodies drawn from a mix at the points of a Halton sequence in a box: evenly, but with no pattern, and some
/// may overlap.
struct ScatterGenerator {
  int count = 0;
  Vec3 origin{};  // middle of the floor of the box
  Vec3 size{};
  bool turned = false;  // random rotations
  std::vector<MixEntry> mix;
};

/// `count` bodies drawn from a mix that drop from a box: `at_once` of them every `every` steps, round and round. One
/// whose turn comes again is taken out of the world and put in anew, at another place of the box.
struct RespawnGenerator {
  int count = 0;
  int at_once = 1;
  int every = 1;
  Vec3 origin{};  // middle of the box
  Vec3 size{};
  Vec3 velocity{};
  bool turned = false;  // random rotations
  std::vector<MixEntry> mix;
};

/// Links from a fixed anchor towards a last body, each joined to the one before by a ball joint.
struct ChainGenerator {
  BodyTraits link;  // a capsule or box whose y is the length
  BodyTraits end;
  int links = 1;
  Vec3 anchor{};
  Vec3 direction{0, -1, 0};
  double pitch = 0;       // distance between joints
  double end_offset = 0;  // from the last joint to the centre of the last body
};

/// Bodies on a lattice that hangs down from its top row, each joined to its neighbours by ball joints half way.
struct JointGridGenerator {
  BodyTraits node;
  std::array<int, 2> columns{1, 1};  // along x, and down
  std::array<double, 2> spacing{};
  Vec3 origin{};  // middle of the top row
  int held = 1;   // bodies in the middle of the top row that ball joints hold in the world
};

/// A drum that turns about the z axis, and in it paddles that take along what lies at the bottom; one kinematic body.
/// Two fixed boxes close its ends.
struct DrumGenerator {
  Vec3 centre{};
  double radius = 1;  // of the room inside: of the circle that touches the staves
  double length = 1;  // along z
  double thickness = 0.1;
  int staves = 24;
  int paddles = 4;
  double depth = 0;  // how far paddles reach inwards
  double spin = 0;   // rad/s
  Material material;
};

/// Ragdolls of eleven capsules and ten joints (cone-twist and hinge), on a lattice.
struct RagdollGenerator {
  int count = 0;
  std::array<int, 2> columns{1, 1};
  Vec3 spacing{};
  Vec3 origin{};
  double height = 1.8;
  double mass = 75;
  double spin = 0;  // largest initial spin, rad/s
  Material material;
};

/// A floor and four walls of fixed boxes, and a lid if asked for; `size` is the room inside.
struct ContainerGenerator {
  Vec3 floor{};  // middle of the floor
  Vec3 size{};
  double thickness = 1;
  bool lid = false;
  Material material;
};

/// What a file of another program holds, read when the scene was: its shapes, and bodies and joints that are already
/// where the scene wants them. Indices are those of its own lists.
struct ImportGenerator {
  std::string file;
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<std::array<std::size_t, 2>> exclusions;
};

using Generator =
    std::variant<GridGenerator, WallGenerator, ChainGenerator, RagdollGenerator, ContainerGenerator, PyramidGenerator,
                 TowerGenerator, ScatterGenerator, RespawnGenerator, BallRandomGenerator, Assorted80Generator,
                 JointGridGenerator, DrumGenerator, ImportGenerator>;

/// As many bodies as it makes, or a few more.
std::size_t most_bodies(const Generator& generator);

}  // namespace boxstream::scenes
