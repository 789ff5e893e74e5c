// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace boxstream::scenes {

/// A scene as its file states it: plain data, checked, names resolved to indices, nothing of an engine in it.
/// Units are SI; y is up. Docs of each field: demos/scenes/README.md.

using Vec3 = std::array<double, 3>;

/// Rotation as x, y, z, w of a unit quaternion.
using Quat = std::array<double, 4>;

struct Meta {
  std::string name;
  std::string about;
  std::string source;
  std::vector<std::string> tags;
};

struct Time {
  double dt = 1.0 / 60.0;
  int steps = 600;
};

struct Bounds {
  Vec3 min{};
  Vec3 max{};
};

struct WorldSettings {
  Vec3 gravity{0, -9.81, 0};
  /// Where things are expected to stay. Sweep-and-prune broad-phases need it, and pictures aim at it.
  Bounds bounds;
  std::uint64_t seed = 1;
};

struct Solver {
  int iterations = 10;
  bool split_impulse = true;
  bool cache_friction = false;  // take friction directions over from the step before
};

struct Material {
  double friction = 0.5;
  double rolling = 0;
  double spinning = 0;
  double restitution = 0;
};

struct BoxShape {
  Vec3 half_extents;
};
struct SphereShape {
  double radius;
};
/// Along local y; `height` is between the centres of the two end spheres.
struct CapsuleShape {
  double radius;
  double height;
};
/// Along local y; `height` is the whole height, centred.
struct CylinderShape {
  double radius;
  double height;
};
struct ConeShape {
  double radius;
  double height;
};
struct HullShape {
  std::vector<Vec3> points;
};
/// Fixed bodies only: the half-space { x : normal . x <= offset } is solid.
struct PlaneShape {
  Vec3 normal;
  double offset;
};
/// Fixed bodies only: a grid of heights, row after row along z, centred on the body's position in x and z.
struct HeightfieldShape {
  int columns;
  int rows;
  double cell;
  std::vector<float> heights;
};
/// Fixed bodies only.
struct MeshShape {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};
struct CompoundChild {
  std::size_t shape;  // an earlier convex shape
  Vec3 position;
  Quat rotation;
};
struct CompoundShape {
  std::vector<CompoundChild> children;
};

using ShapeValue = std::variant<BoxShape, SphereShape, CapsuleShape, CylinderShape, ConeShape, HullShape, PlaneShape,
                                HeightfieldShape, MeshShape, CompoundShape>;

struct Shape {
  std::string name;
  ShapeValue value;
};

enum class BodyType { fixed, kinematic, dynamic };

struct Ccd {
  double threshold;  // motion per step beyond which the body is swept
  double radius;     // of the sphere swept for it
};

/// What bodies made from one template share. Exactly one of mass and density is given for dynamic bodies.
struct BodyTraits {
  std::size_t shape = 0;
  Material material;
  BodyType type = BodyType::dynamic;
  std::optional<double> mass;
  std::optional<double> density;
  double linear_damping = 0;
  double angular_damping = 0;
  std::optional<std::uint32_t> group;
  std::optional<std::uint32_t> mask;
  std::optional<Ccd> ccd;
  bool sleep = true;
};

struct Body {
  std::string name;  // may be empty
  BodyTraits traits;
  Vec3 position{};
  Quat rotation{0, 0, 0, 1};
  Vec3 velocity{};
  Vec3 spin{};  // rad/s
};

/// One kind of body among those that a grid deals out.
struct MixEntry {
  BodyTraits traits;
  double weight = 1;
  std::array<double, 2> scale{1, 1};  // sizes are drawn log-uniformly from this range
};

/// `count` bodies on a lattice, layer after layer upwards, drawn from a mix.
struct GridGenerator {
  int count = 0;
  std::array<int, 2> columns{1, 1};  // along x and z
  Vec3 spacing{};
  Vec3 origin{};        // centre of the lowest layer
  double jitter = 0;    // largest offset per axis, in metres
  bool turned = false;  // random rotations
  double swirl = 0;     // initial speed around the vertical through the origin
  double speed = 0;     // largest size of a random initial velocity, uniform in a ball
  std::vector<MixEntry> mix;
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
  bool flat = false;   // one brick deep: a triangular wall
  Vec3 origin{};       // middle of the foot
  double degrees = 0;  // how far it is turned about the vertical
  double gap = 0;      // between bricks of a layer
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

using Generator = std::variant<GridGenerator, WallGenerator, ChainGenerator, RagdollGenerator, ContainerGenerator,
                               PyramidGenerator, TowerGenerator, ScatterGenerator>;

struct BallJoint {
  Vec3 pivot;
};
struct HingeJoint {
  Vec3 pivot;
  Vec3 axis;
  std::optional<std::array<double, 2>> limits;  // radians
};
/// `axis` is the twist axis; swing is about the two others.
struct ConeTwistJoint {
  Vec3 pivot;
  Vec3 axis;
  double swing1;
  double swing2;
  double twist;
};
using JointValue = std::variant<BallJoint, HingeJoint, ConeTwistJoint>;

/// Places and axes are in world coordinates at the start.
struct Joint {
  std::size_t a = 0;             // index of a body
  std::optional<std::size_t> b;  // none: the world
  JointValue value;
  bool collide = false;  // may the two bodies touch each other?
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

struct ClothSoft {
  std::array<Vec3, 4> corners;  // 00, 10, 01, 11
  std::array<int, 2> resolution;
  int pinned = 0;  // bit per corner, in the order above
};
struct BallSoft {
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

/// Rays that are cast after each step, from one point to points evenly spaced on a circle around the vertical through
/// it; the circle turns from step to step.
struct RayFan {
  int count = 1;
  Vec3 from{};
  double radius = 1;
  double drop = 1;     // how far the circle is below the point
  double degrees = 1;  // of turning, in a step
};

/// Air that drags all dynamic bodies around the vertical through `centre`, up in the middle and down at the walls, so
/// that they never come to rest. It turns as a rigid whole and its convection has no sources or sinks: it spreads
/// bodies evenly, but for what their inertia does.
struct SwirlField {
  Vec3 centre{};       // middle of the floor
  double radius = 1;   // of the room
  double height = 1;   // of the room
  double speed = 0;    // around, at `radius`
  double updraft = 0;  // on the axis, half way up
  double rate = 0;     // 1/s: how fast bodies take on the speed of the air
};

/// What a scene says about itself; every number is checked against what was built.
struct Expect {
  std::optional<std::uint64_t> objects;  // everything the broad-phase sees
  std::optional<std::uint64_t> bodies;   // rigid, fixed ones included
  std::optional<std::uint64_t> fixed;
  std::optional<std::uint64_t> kinematic;
  std::optional<std::uint64_t> dynamic;
  std::optional<std::uint64_t> joints;
  std::optional<std::uint64_t> sensors;
  std::optional<std::uint64_t> characters;
  std::optional<std::uint64_t> soft_bodies;
  std::optional<std::uint64_t> soft_nodes;
  std::optional<std::uint64_t> boxes;
  std::optional<std::uint64_t> spheres;
  std::optional<std::uint64_t> capsules;
  std::optional<std::uint64_t> cylinders;
  std::optional<std::uint64_t> cones;
  std::optional<std::uint64_t> hulls;
  std::optional<std::uint64_t> planes;
  std::optional<std::uint64_t> heightfields;
  std::optional<std::uint64_t> meshes;
  std::optional<std::uint64_t> compounds;
  std::optional<double> size_ratio;  // largest over smallest box diagonal of the dynamic bodies, at least
};

struct Scene {
  std::string file;  // where it came from, for messages
  Meta meta;
  Time time;
  WorldSettings world;
  Solver solver;
  std::string broadphase = "boxstream";
  std::vector<Shape> shapes;
  std::vector<Body> bodies;
  std::vector<Generator> generators;
  std::vector<Joint> joints;
  std::vector<Sensor> sensors;
  std::vector<Character> characters;
  std::vector<SoftBody> soft_bodies;
  std::vector<SwirlField> swirls;
  std::vector<RayFan> rays;
  Expect expect;
};

/// Reads a scene file. Throws SceneError; a file that names other files (meshes) reads them too.
Scene load_scene(const std::string& path);

/// The same from text; `name` stands for the file in messages, and files that the scene names are looked up beside it.
Scene parse_scene(const std::string& text, const std::string& name);

/// The same scene with about `factor` (> 0) times as many generated bodies: counts scale with `factor`, rooms and
/// lattices with its cube root, walls and cloths with its square root, so that densities stay. Single bodies, chains
/// and sensors stay as they are; `expect` is dropped because it speaks of the full size.
Scene scaled(const Scene& scene, double factor);

}  // namespace boxstream::scenes
