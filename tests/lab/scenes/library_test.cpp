// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <numbers>
#include <set>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/expand_parts.hpp"
#include "shipped.hpp"

namespace boxstream::scenes_test {
namespace {

using namespace scenes;

double length(const Vec3& v) {
  return std::hypot(v[0], v[1], v[2]);
}
Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Scene with_generator(Generator generator) {
  Scene scene;
  scene.world.seed = 5;
  scene.shapes = {{"box", BoxShape{{0.5, 0.5, 0.5}}}, {"ball", SphereShape{0.5}}};
  scene.generators.push_back(std::move(generator));
  return scene;
}

BodyTraits traits(std::size_t shape) {
  BodyTraits t;
  t.shape = shape;
  t.mass = 1;
  return t;
}

Vec3 half_extents(const Expanded& expanded, const Body& body) {
  return std::get<BoxShape>(expanded.shapes[body.traits.shape].value).half_extents;
}

/// FNV-1a of places, velocities and sizes, bit for bit.
std::uint64_t hash_of(const Expanded& expanded) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  const auto add = [&](const Vec3& v) {
    for (const double x : v)
      for (int byte = 0; byte < 8; ++byte)
        hash = (hash ^ (std::bit_cast<std::uint64_t>(x) >> 8 * byte & 0xff)) * 0x100000001b3u;
  };
  for (const Body& body : expanded.bodies) {
    add(body.position);
    add(body.velocity);
    if (std::holds_alternative<BoxShape>(expanded.shapes[body.traits.shape].value)) add(half_extents(expanded, body));
  }
  return hash;
}

TEST(BallRandom, IsUniformInPlaceAndVelocity) {
  BallRandomGenerator ball;
  ball.start = {8000, {1, 2, 3}, 10, 4};
  ball.mix = {{traits(0), 3, {1, 1}}, {traits(1), 1, {1, 1}}};
  const Expanded expanded = expand(with_generator(ball));
  ASSERT_EQ(expanded.bodies.size(), 8000u);
  int near = 0, slow = 0, balls = 0, alike = 0;
  for (const Body& body : expanded.bodies) {
    const Vec3 offset = minus(body.position, ball.start.centre);
    ASSERT_LE(length(offset), 10 + 1e-9);
    ASSERT_LE(length(body.velocity), 4 + 1e-9);
    near += length(offset) < 5;
    slow += length(body.velocity) < 2;
    balls += body.traits.shape == 1;
    alike += offset[0] * body.velocity[0] + offset[1] * body.velocity[1] + offset[2] * body.velocity[2] > 0;
    EXPECT_EQ(body.rotation, (Quat{0, 0, 0, 1}));
  }
  // An eighth of the volume lies within half the radius; six standard deviations are 178.
  EXPECT_NEAR(near, 1000, 178);
  EXPECT_NEAR(slow, 1000, 178);
  EXPECT_NEAR(alike, 4000, 269);  // velocities know nothing of places
  EXPECT_EQ(balls, 2000);
}

TEST(Assorted80, IsTheListOfBroadmark) {
  Assorted80Generator assorted;
  assorted.start = {240, {0, 0, 0}, 10, 4};
  assorted.unit = traits(0);
  const Expanded expanded = expand(with_generator(assorted));
  ASSERT_EQ(expanded.bodies.size(), 240u);
  double least = 1e9, most = 0, sum = 0;
  for (std::size_t i = 0; i < 240; ++i) {
    const Body& body = expanded.bodies[i];
    EXPECT_EQ(body.traits.mass, 1);
    Vec3 size = half_extents(expanded, body);
    for (double& x : size) x *= 2;
    const std::size_t k = i % 80;
    const auto is = [&](double x, double y, double z) { EXPECT_EQ(size, (Vec3{x, y, z})) << i; };
    if (k < 4)
      is(0.5, 0.5, 0.5);
    else if (k < 8)
      is(1.9, 1.9, 1.9);
    else if (k < 11)
      is(15.2, 0.4, 0.4);
    else if (k == 11)
      is(0.4, 15.2, 0.4);
    else if (k == 12)
      is(0.4, 0.4, 15.2);
    else if (k == 13)
      is(1.9, 5.7, 0.1);
    else if (k == 14)
      is(1.9, 0.1, 5.7);
    else if (k == 15)
      is(0.1, 1.9, 0.3);
    else if (k == 16)
      is(3.8, 3.8, 0.1);
    else if (k == 17)
      is(3.8, 0.1, 3.8);
    else if (k == 18)
      is(0.1, 3.8, 3.8);
    else
      for (const double side : size) {
        least = std::min(least, side);
        most = std::max(most, side);
        sum += side;
      }
  }
  EXPECT_GE(least, 0.0803);
  EXPECT_LT(least, 0.12);
  EXPECT_LE(most, 1.5257);
  EXPECT_GT(most, 1.48);
  EXPECT_NEAR(sum / (3 * 3 * 61), 0.803, 0.11);  // six standard errors
}

TEST(Assorted80, IsMeasuredInItsUnit) {
  Assorted80Generator assorted;
  assorted.start.count = 12;
  assorted.unit = traits(0);
  Scene scene = with_generator(assorted);
  scene.shapes[0].value = BoxShape{{1, 2, 3}};
  const Expanded expanded = expand(scene);
  EXPECT_EQ(half_extents(expanded, expanded.bodies[0]), (Vec3{0.5, 1, 1.5}));
  EXPECT_EQ(half_extents(expanded, expanded.bodies[11]), (Vec3{0.4, 30.4, 1.2000000000000002}));
}

TEST(JointGrid, EveryNeighbourIsJoinedHalfWay) {
  JointGridGenerator grid;
  grid.node = traits(1);
  grid.columns = {5, 4};
  grid.spacing = {1, 2};
  grid.origin = {3, 10, -1};
  grid.held = 3;
  const Expanded expanded = expand(with_generator(grid));
  ASSERT_EQ(expanded.bodies.size(), 20u);
  ASSERT_EQ(expanded.joints.size(), 4u * 4 + 5 * 3 + 3);
  EXPECT_EQ(expanded.bodies[2].position, (Vec3{3, 10, -1}));
  EXPECT_EQ(expanded.bodies[19].position, (Vec3{5, 4, -1}));
  std::set<std::size_t> held;
  std::set<std::pair<std::size_t, std::size_t>> joined;
  for (const Joint& joint : expanded.joints) {
    const Vec3 pivot = std::get<BallJoint>(joint.value).pivot;
    const Vec3& a = expanded.bodies[joint.a].position;
    if (!joint.b) {
      EXPECT_EQ(pivot, a);
      held.insert(joint.a);
      continue;
    }
    const Vec3& b = expanded.bodies[*joint.b].position;
    EXPECT_TRUE(length(minus(a, b)) == 1 || length(minus(a, b)) == 2);
    for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(pivot[d], (a[d] + b[d]) / 2, 1e-12);
    joined.insert({joint.a, *joint.b});
  }
  EXPECT_EQ(held, (std::set<std::size_t>{1, 2, 3}));
  EXPECT_EQ(joined.size(), 31u);
}

/// Is the point in a box of this shape, or of one of its parts?
bool is_inside(const Expanded& expanded, std::size_t shape, const Vec3& p) {
  const ShapeValue& value = expanded.shapes[shape].value;
  if (const auto* const box = std::get_if<BoxShape>(&value)) {
    for (std::size_t d = 0; d < 3; ++d)
      if (std::abs(p[d]) > box->half_extents[d]) return false;
    return true;
  }
  for (const CompoundChild& child : std::get<CompoundShape>(value).children) {
    const Quat& q = child.rotation;
    if (is_inside(expanded, child.shape, turned({-q[0], -q[1], -q[2], q[3]}, minus(p, child.position)))) return true;
  }
  return false;
}

TEST(Drum, IsARoundRoomWithoutGapsAndHasItsPaddles) {
  DrumGenerator drum;
  drum.centre = {1, 2, 3};
  drum.radius = 5;
  drum.length = 4;
  drum.thickness = 0.5;
  drum.staves = 12;
  drum.paddles = 3;
  drum.depth = 1;
  drum.spin = 2;
  const Expanded expanded = expand(with_generator(drum));
  ASSERT_EQ(expanded.bodies.size(), 3u);
  EXPECT_EQ(expanded.bodies[0].traits.type, BodyType::kinematic);
  EXPECT_EQ(expanded.bodies[0].spin, (Vec3{0, 0, 2}));
  const auto solid = [&](double radius, double angle, double z) {
    const Vec3 p{1 + radius * std::cos(angle), 2 + radius * std::sin(angle), 3 + z};
    for (const Body& body : expanded.bodies)
      if (is_inside(expanded, body.traits.shape, minus(p, body.position))) return true;
    return false;
  };
  const double pi = std::numbers::pi;
  for (int i = 0; i < 720; ++i) {
    const double angle = 2 * pi * i / 720;
    const double to_wall = 5 / std::cos(std::remainder(angle, pi / 6));  // of a regular polygon
    for (const double z : {-1.99, 0.0, 1.99}) {
      for (const double outwards : {0.001, 0.25, 0.499}) EXPECT_TRUE(solid(to_wall + outwards, angle, z)) << i;
      EXPECT_FALSE(solid(3.99, angle, z)) << i;
      const bool paddle = 4.5 * std::abs(std::sin(std::remainder(angle, 2 * pi / 3))) <= 0.25;
      EXPECT_EQ(solid(4.5, angle, z), paddle) << i;
    }
    for (const double z : {-2.01, 2.01})
      for (const double radius : {0.0, 2.5, 5.4}) EXPECT_TRUE(solid(radius, angle, z)) << i;
  }
}

TEST(Pyramid, RepeatsAroundItsOrigin) {
  PyramidGenerator pyramid;
  pyramid.brick = traits(0);
  pyramid.levels = 3;
  pyramid.flat = true;
  pyramid.origin = {10, 0, 0};
  pyramid.repeat = {3, 2};
  pyramid.spacing = {5, 2};
  const Expanded expanded = expand(with_generator(pyramid));
  ASSERT_EQ(expanded.bodies.size(), 6u * 6);
  EXPECT_EQ(most_bodies(Generator(pyramid)), 36u);
  std::set<std::pair<double, double>> tops;
  for (const Body& body : expanded.bodies)
    if (body.position[1] > 2) tops.insert({body.position[0], body.position[2]});
  EXPECT_EQ(tops, (std::set<std::pair<double, double>>{{5, -1}, {10, -1}, {15, -1}, {5, 1}, {10, 1}, {15, 1}}));
}

TEST(Library, BodiesOfTheLatticesAreApart) {
  for (const char* const name : {"box3d_large_pyramid", "box3d_many_pyramids", "box3d_joint_grid", "box3d_washer",
                                 "jolt_pyramid", "hopper", "jolt_high_speed", "box3d_large_world"}) {
    Scene scene = load_scene(file_of(name));
    scene = scaled(scene, 0.05);
    const Expanded expanded = expand(scene);
    std::vector<std::pair<Vec3, double>> balls;  // that each body contains
    for (const Body& body : expanded.bodies) {
      if (body.traits.type != BodyType::dynamic) continue;
      const ShapeValue& shape = expanded.shapes[body.traits.shape].value;
      double radius = 0;
      if (const auto* const box = std::get_if<BoxShape>(&shape)) radius = box->half_extents[0];
      if (const auto* const sphere = std::get_if<SphereShape>(&shape)) radius = sphere->radius;
      if (const auto* const pill = std::get_if<CapsuleShape>(&shape)) radius = pill->radius;
      ASSERT_GT(radius, 0) << name;
      balls.emplace_back(body.position, radius);
    }
    ASSERT_GT(balls.size(), 50u) << name;
    for (std::size_t i = 0; i < balls.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        ASSERT_GE(length(minus(balls[i].first, balls[j].first)), balls[i].second + balls[j].second - 1e-9) << name;
  }
}

TEST(Library, BroadmarkIsTheSameForEver) {
  EXPECT_EQ(hash_of(expand(load_scene(file_of("broadmark_fall_cubes")))), 15339521564297345779u);
  EXPECT_EQ(hash_of(expand(load_scene(file_of("broadmark_fall_assorted")))), 1704143856895794419u);
}

TEST(Library, BroadmarkHasItsNumbersAtEverySize) {
  for (const char* const motion : {"fall", "brownian", "gravity"}) {
    for (const char* const kind : {"cubes", "spheres", "assorted"}) {
      const std::string name = std::string("broadmark_") + motion + "_" + kind;
      SCOPED_TRACE(name);
      const Scene thousand = load_scene(file_of(name));
      for (const double factor : {1.0, 10.0, 100.0}) {
        const Scene scene = scaled(thousand, factor);
        const double side = std::cbrt(1000 * factor / 0.01), close = 1e-5 * side;
        const auto& room = std::get<ContainerGenerator>(scene.generators[0]);
        for (std::size_t d = 0; d < 3; ++d) {
          EXPECT_NEAR(room.size[d], side, close);
          EXPECT_NEAR(scene.world.bounds.max[d] - scene.world.bounds.min[d], side, close);
        }
        EXPECT_NEAR(room.thickness, side / 2, close);
        EXPECT_TRUE(room.lid);
        const auto* const ball = std::get_if<BallRandomGenerator>(&scene.generators[1]);
        const BallStart& start = ball ? ball->start : std::get<Assorted80Generator>(scene.generators[1]).start;
        EXPECT_EQ(start.count, 1000 * factor);
        EXPECT_NEAR(start.radius, 0.45 * side, close);
        EXPECT_NEAR(start.speed, 0.75 * side, close);
        EXPECT_NEAR(start.centre[1] - room.floor[1], side / 2, close);
        const double g0 = 0.0981 * side;
        if (scene.world.tumbling) {
          EXPECT_NEAR(scene.world.tumbling->strength, 4 * g0, close);
          EXPECT_NEAR(scene.world.tumbling->degrees_per_second * scene.time.dt, 1.935, 1e-3);
        } else {
          EXPECT_NEAR(scene.world.gravity[1], std::string(motion) == "fall" ? -g0 : 0, close);
        }
        if (std::string(motion) == "brownian") {
          const auto& impulses = std::get<ImpulsesField>(scene.fields.at(0));
          EXPECT_EQ(impulses.share, 0.01);
          EXPECT_NEAR(impulses.speed, 0.75 * side, close);
        }
        EXPECT_EQ(scene.world.tumbling.has_value(), std::string(motion) == "gravity");
        EXPECT_EQ(scene.world.on_leave, OnLeave::freeze);
        EXPECT_NEAR(scene.time.dt, 1.0 / 30, 1e-12);
        EXPECT_EQ(scene.time.substeps, 4);
        EXPECT_EQ(scene.solver.iterations, 6);
        EXPECT_EQ(scene.time.steps, 1000);
      }
    }
  }
}

TEST(Scaled, GroundsGrowFlatAndSomeGridsNotAtAll) {
  const Scene large = scaled(load_scene(file_of("box3d_large_world")), 4);
  const auto& ground = std::get<GridGenerator>(large.generators[0]);
  EXPECT_EQ(ground.count, 40'000);
  EXPECT_EQ(ground.columns, (std::array<int, 2>{200, 200}));
  EXPECT_EQ(std::get<GridGenerator>(large.generators[1]).count, 100);
  const Scene pyramids = scaled(load_scene(file_of("box3d_many_pyramids")), 0.25);
  EXPECT_EQ(std::get<PyramidGenerator>(pyramids.generators[0]).repeat, (std::array<int, 2>{7, 7}));
  const Scene net = scaled(load_scene(file_of("box3d_joint_grid")), 0.0001);
  EXPECT_EQ(std::get<JointGridGenerator>(net.generators[0]).columns, (std::array<int, 2>{1, 1}));
  EXPECT_EQ(std::get<JointGridGenerator>(net.generators[0]).held, 1);
}

TEST(Scaled, RefusesWhatIsTooMuch) {
  const Scene pile = load_scene(file_of("pile"));
  EXPECT_NO_THROW(scaled(pile, 400));
  EXPECT_THROW(scaled(pile, 600), std::invalid_argument);
  EXPECT_THROW(scaled(pile, 1e300), std::invalid_argument);
  EXPECT_THROW(scaled(load_scene(file_of("box3d_large_pyramid")), 1000), std::invalid_argument);
}

}  // namespace
}  // namespace boxstream::scenes_test
