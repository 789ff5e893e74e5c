// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/expand_parts.hpp"
#include "formats/scene_model/random.hpp"
#include "shipped.hpp"
#include "small_scene.hpp"

namespace boxstream::scenes_test {
namespace {

using namespace scenes;

double distance(const Vec3& a, const Vec3& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Scene with_generator(Generator generator) {
  Scene scene;
  scene.world.seed = 5;
  scene.shapes = {{"box", BoxShape{{0.4, 0.2, 0.2}}}, {"ball", SphereShape{0.5}}};
  scene.generators.push_back(std::move(generator));
  return scene;
}

BodyTraits traits(std::size_t shape, double mass) {
  BodyTraits t;
  t.shape = shape;
  t.mass = mass;
  return t;
}

TEST(RandomNumbers, AreTheSameEverywhere) {
  // The engine itself is pinned by the C++ standard: its 10000th number with the default seed.
  std::mt19937_64 engine;
  engine.discard(9999);
  ASSERT_EQ(engine(), 9981545732273789042u);

  Random random(1);
  const double units[] = {0x1.122deafddb434p-3, 0x1.175c928118c7cp-3, 0x1.ce0b479deb99p-2, 0x1.5876015e4d7p-6};
  for (const double expected : units) EXPECT_EQ(random.unit(), expected);
  const std::uint64_t belows[] = {350, 911, 470, 74, 569, 635};
  for (const std::uint64_t expected : belows) EXPECT_EQ(random.below(1000), expected);
}

TEST(RandomNumbers, StayInTheirRanges) {
  Random random(2);
  double sum = 0, longest = 0;
  for (int i = 0; i < 10000; ++i) {
    const double x = random.log_range(0.01, 100);
    ASSERT_GE(x, 0.01);
    ASSERT_LT(x, 100.0001);
    sum += std::log10(x);
    longest = std::max(longest, distance(random.in_ball(2), {}));
    const Quat q = random.rotation();
    ASSERT_NEAR(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3], 1, 1e-12);
  }
  EXPECT_NEAR(sum / 10000, 0, 0.05);  // decades evenly: mean of log10 over [-2, 2], standard error 0.012
  EXPECT_LE(longest, 2);
  EXPECT_GT(longest, 1.9);
}

TEST(Grid, DealsTheMixExactlyAndScalesMassWithVolume) {
  GridGenerator grid;
  grid.count = 100;
  grid.columns = {5, 5};
  grid.spacing = {2, 2, 2};
  grid.mix = {{traits(0, 8), 3, {1, 1}}, {traits(1, 1), 1, {0.5, 0.5}}};
  const Expanded expanded = expand(with_generator(grid));
  ASSERT_EQ(expanded.bodies.size(), 100u);
  int boxes = 0;
  for (const Body& body : expanded.bodies) {
    const ShapeValue& shape = expanded.shapes[body.traits.shape].value;
    if (std::holds_alternative<BoxShape>(shape)) {
      ++boxes;
      EXPECT_EQ(body.traits.mass, 8);
    } else {
      EXPECT_EQ(std::get<SphereShape>(shape).radius, 0.25);
      EXPECT_EQ(body.traits.mass, 0.125);
    }
  }
  EXPECT_EQ(boxes, 75);
  // No two share a place.
  for (std::size_t i = 0; i < 100; ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_GE(distance(expanded.bodies[i].position, expanded.bodies[j].position), 2);
}

TEST(Wall, RowsAreEquallyLongAndBricksOnlyTouch) {
  WallGenerator wall;
  wall.brick = traits(0, 10);
  wall.columns = 6;
  wall.rows = 4;
  wall.gap = 0.01;
  const Expanded expanded = expand(with_generator(wall));
  ASSERT_EQ(expanded.bodies.size(), 6u + 7u + 6u + 7u);
  double ends[4][2];
  for (auto& row : ends) row[0] = 1e9, row[1] = -1e9;
  double mass[4] = {};
  for (const Body& body : expanded.bodies) {
    const auto row = static_cast<std::size_t>(std::lround((body.position[1] - 0.2) / 0.4));
    const double half = std::get<BoxShape>(expanded.shapes[body.traits.shape].value).half_extents[0];
    ends[row][0] = std::min(ends[row][0], body.position[0] - half);
    ends[row][1] = std::max(ends[row][1], body.position[0] + half);
    mass[row] += *body.traits.mass;
    for (const Body& other : expanded.bodies) {
      if (&other == &body || other.position[1] != body.position[1]) continue;
      const double other_half = std::get<BoxShape>(expanded.shapes[other.traits.shape].value).half_extents[0];
      ASSERT_GE(std::abs(other.position[0] - body.position[0]), half + other_half + 0.01 - 1e-9);
    }
  }
  for (const auto& row : ends) {
    EXPECT_NEAR(row[0], ends[0][0], 1e-9);
    EXPECT_NEAR(row[1], ends[0][1], 1e-9);
  }
  EXPECT_NEAR(mass[1], mass[0], 0.2);  // less by half a gap of 1 cm
}

TEST(Chain, HangsTogetherInAnyDirection) {
  for (const Vec3& direction : {Vec3{0, -1, 0}, Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{0, -0.6, -0.8}}) {
    ChainGenerator chain;
    chain.link = traits(0, 1);
    chain.end = traits(1, 5);
    chain.links = 5;
    chain.anchor = {1, 2, 3};
    chain.direction = direction;
    chain.pitch = 0.5;
    chain.end_offset = 0.7;
    const Expanded expanded = expand(with_generator(chain));
    ASSERT_EQ(expanded.bodies.size(), 6u);
    ASSERT_EQ(expanded.joints.size(), 6u);
    EXPECT_FALSE(expanded.joints[0].b.has_value());
    EXPECT_EQ(std::get<BallJoint>(expanded.joints[0].value).pivot, chain.anchor);
    for (std::size_t i = 1; i < 6; ++i) {
      const Vec3 pivot = std::get<BallJoint>(expanded.joints[i].value).pivot;
      EXPECT_EQ(expanded.joints[i].b, i - 1);
      EXPECT_NEAR(distance(pivot, expanded.bodies[i - 1].position), 0.25, 1e-9);
      EXPECT_NEAR(distance(pivot, expanded.bodies[i].position), i == 5 ? 0.7 : 0.25, 1e-9);
    }
  }
}

TEST(Ragdolls, WeighWhatTheyShouldAndJointsAreBetweenTheirBodies) {
  RagdollGenerator dolls;
  dolls.count = 3;
  dolls.columns = {3, 1};
  dolls.spacing = {3, 3, 3};
  const Expanded expanded = expand(with_generator(dolls));
  ASSERT_EQ(expanded.bodies.size(), 33u);
  ASSERT_EQ(expanded.joints.size(), 30u);
  for (std::size_t doll = 0; doll < 3; ++doll) {
    double mass = 0;
    for (std::size_t i = 0; i < 11; ++i) mass += *expanded.bodies[11 * doll + i].traits.mass;
    EXPECT_NEAR(mass, dolls.mass, 1e-9);
  }
  for (const Joint& joint : expanded.joints) {
    EXPECT_EQ(joint.a / 11, *joint.b / 11);
    const Vec3 pivot = std::visit([](const auto& j) { return j.pivot; }, joint.value);
    // Within each limb: nearer than its half length and radius.
    for (const std::size_t body : {joint.a, *joint.b}) {
      const auto& capsule = std::get<CapsuleShape>(expanded.shapes[expanded.bodies[body].traits.shape].value);
      EXPECT_LE(distance(pivot, expanded.bodies[body].position), capsule.height / 2 + capsule.radius + 0.03);
    }
  }
}

TEST(Pyramid, StandsLayerOnLayerAndTurnsAsAWhole) {
  PyramidGenerator pyramid;
  pyramid.brick = traits(0, 10);
  pyramid.levels = 4;
  pyramid.gap = 0.01;
  pyramid.origin = {3, 1, -2};
  const Expanded square = expand(with_generator(pyramid));
  ASSERT_EQ(square.bodies.size(), 16u + 9u + 4u + 1u);
  EXPECT_NEAR(square.bodies.back().position[0], 3, 1e-9);
  EXPECT_NEAR(square.bodies.back().position[1], 1 + 0.2 * 7, 1e-9);
  EXPECT_NEAR(square.bodies.back().position[2], -2, 1e-9);
  for (const Body& body : square.bodies)
    for (const Body& other : square.bodies) {
      if (&other == &body || other.position[1] != body.position[1]) continue;
      EXPECT_TRUE(std::abs(other.position[0] - body.position[0]) >= 0.8 + 0.01 - 1e-9 ||
                  std::abs(other.position[2] - body.position[2]) >= 0.4 + 0.01 - 1e-9);
    }
  pyramid.flat = true;
  pyramid.degrees = 90;
  const Expanded wall = expand(with_generator(pyramid));
  ASSERT_EQ(wall.bodies.size(), 4u + 3u + 2u + 1u);
  for (const Body& body : wall.bodies) {
    EXPECT_NEAR(body.position[0], 3, 1e-9);  // it ran along x, and now runs along z
    const Vec3 length = turned(body.rotation, {1, 0, 0});
    EXPECT_NEAR(std::abs(length[2]), 1, 1e-9);
  }
  EXPECT_NEAR(std::abs(wall.bodies[0].position[2] - wall.bodies[3].position[2]), 3 * 0.81, 1e-9);
}

TEST(Tower, RingsTouchNobodyAndAreTurnedByHalfABrick) {
  TowerGenerator tower;
  tower.brick = traits(0, 10);
  tower.levels = 3;
  tower.around = 8;
  tower.gap = 0.1;
  const Expanded expanded = expand(with_generator(tower));
  ASSERT_EQ(expanded.bodies.size(), 24u);
  const Vec3 half{0.4, 0.2, 0.2};
  for (std::size_t i = 0; i < 24; ++i) {
    const Body& body = expanded.bodies[i];
    EXPECT_NEAR(body.position[1], 0.2 + 0.4 * static_cast<double>(i / 8), 1e-9);
    // The inner edges of neighbours are `gap` apart.
    const Body& next = expanded.bodies[i / 8 * 8 + (i + 1) % 8];
    const auto edge = [&](const Body& b, double side) {
      const Vec3 offset = turned(b.rotation, {side * half[0], 0, -half[2]});
      return Vec3{b.position[0] + offset[0], b.position[1], b.position[2] + offset[2]};
    };
    EXPECT_NEAR(distance(edge(body, 1), edge(next, -1)), tower.gap * std::cos(std::numbers::pi / 8), 1e-9);
  }
  // The middle of a brick lies over the joint below.
  const Vec3 below = expanded.bodies[0].position, beside = expanded.bodies[1].position,
             above = expanded.bodies[8].position;
  EXPECT_NEAR(distance(above, below), distance(above, beside), 1e-9);
}

TEST(Scatter, FillsItsBoxEvenly) {
  ScatterGenerator scatter;
  scatter.count = 512;
  scatter.origin = {10, -4, 3};
  scatter.size = {8, 16, 4};
  scatter.mix = {{traits(0, 1), 1, {1, 1}}, {traits(1, 1), 3, {1, 1}}};
  const Expanded expanded = expand(with_generator(scatter));
  ASSERT_EQ(expanded.bodies.size(), 512u);
  int cells[8] = {}, balls = 0;
  for (const Body& body : expanded.bodies) {
    const Vec3 at{body.position[0] - 6, body.position[1] + 4, body.position[2] - 1};
    for (std::size_t d = 0; d < 3; ++d) {
      ASSERT_GT(at[d], 0);
      ASSERT_LT(at[d], scatter.size[d]);
    }
    ++cells[(at[0] > 4) + 2 * (at[1] > 8) + 4 * (at[2] > 2)];
    balls += std::holds_alternative<SphereShape>(expanded.shapes[body.traits.shape].value);
  }
  for (const int count : cells) EXPECT_NEAR(count, 64, 6);  // at random, one in two would be farther off
  EXPECT_EQ(balls, 384);
}

TEST(Container, EnclosesItsRoom) {
  ContainerGenerator container;
  container.floor = {1, 2, 3};
  container.size = {10, 6, 8};
  container.thickness = 2;
  container.lid = true;
  const Expanded expanded = expand(with_generator(container));
  ASSERT_EQ(expanded.bodies.size(), 6u);
  const auto inside_any = [&](const Vec3& p) {
    for (const Body& body : expanded.bodies) {
      const Vec3 half = std::get<BoxShape>(expanded.shapes[body.traits.shape].value).half_extents;
      bool inside = true;
      for (std::size_t d = 0; d < 3; ++d) inside = inside && std::abs(p[d] - body.position[d]) <= half[d];
      if (inside) return true;
    }
    return false;
  };
  // Every point of a raster on the faces of the room, a little inwards and a little outwards.
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      for (int i = 0; i <= 10; ++i) {
        for (int j = 0; j <= 10; ++j) {
          Vec3 unit{i / 10.0, i / 10.0, i / 10.0};
          unit[static_cast<std::size_t>((axis + 1) % 3)] = j / 10.0;
          for (const double depth : {-0.01, 0.01}) {
            Vec3 p;
            const auto a = static_cast<std::size_t>(axis);
            unit[a] = side;
            for (std::size_t d = 0; d < 3; ++d) {
              const double inner = 0.02 + 0.96 * unit[d];
              p[d] = container.floor[d] + (d == 1 ? 0 : -container.size[d] / 2) + inner * container.size[d];
            }
            p[a] = container.floor[a] + (a == 1 ? 0 : -container.size[a] / 2) + side * container.size[a] +
                   (side == 1 ? depth : -depth);
            EXPECT_EQ(inside_any(p), depth > 0);
          }
        }
      }
    }
  }
}

TEST(Seed, ChangesPlacesButNothingElse) {
  Scene scene = load_scene(file_of("terrain"));
  const Expanded first = expand(scene);
  const Expanded again = expand(scene);
  scene.world.seed += 1;
  const Expanded other = expand(scene);
  ASSERT_EQ(first.bodies.size(), other.bodies.size());
  int moved = 0;
  for (std::size_t i = 0; i < first.bodies.size(); ++i) {
    ASSERT_EQ(first.bodies[i].position, again.bodies[i].position);
    ASSERT_EQ(first.bodies[i].rotation, again.bodies[i].rotation);
    moved += first.bodies[i].position != other.bodies[i].position;
  }
  EXPECT_GT(moved, 1000);
}

TEST(Scaled, SpeedsAndPlacesGrowInSelfSimilarWorldsAlone) {
  Scene scene;
  scene.fields = {VortexField{{1, 0, 2}, 4, 5, 6, 7, 8}, WindField{{9, 0, 3}, 1.5, 0.4}, DragField{1, 6, 2, 12, 0.4},
                  BuoyancyField{2, 900, 3}, ImpulsesField{0.1, 4}};
  GridGenerator grid;
  grid.count = 8;
  grid.vortex = 2;
  grid.speed = 0.5;
  RespawnGenerator drops;
  drops.count = 4;
  drops.origin = {0, 7, 1};
  drops.size = {2, 1, 2};
  drops.velocity = {0, -4, 0};
  scene.generators = {grid, drops};
  for (const bool self_similar : {false, true}) {
    scene.world.self_similar = self_similar;
    const Scene large = scaled(scene, 27);
    const double by = self_similar ? 3 : 1;
    const auto grows = [](double is, double should) { EXPECT_DOUBLE_EQ(is, should); };
    const auto moves = [](const Vec3& is, const Vec3& should) { EXPECT_NEAR(distance(is, should), 0, 1e-12); };
    const auto& vortex = std::get<VortexField>(large.fields[0]);
    moves(vortex.centre, {by, 0, 2 * by});
    grows(vortex.speed, 6 * by);
    grows(vortex.updraft, 7 * by);
    grows(vortex.rate, 8);
    const auto& wind = std::get<WindField>(large.fields[1]);
    moves(wind.velocity, {9 * by, 0, 3 * by});
    grows(wind.density, 1.5 / by);
    const auto& drag = std::get<DragField>(large.fields[2]);
    grows(drag.linear, 1);
    grows(drag.quadratic, 6 / by);
    grows(drag.density, 12 / by);
    const auto& fluid = std::get<BuoyancyField>(large.fields[3]);
    grows(fluid.level, 2 * by);
    grows(fluid.density, 900);
    grows(std::get<ImpulsesField>(large.fields[4]).speed, 4 * by);
    const auto& lattice = std::get<GridGenerator>(large.generators[0]);
    grows(lattice.vortex, 2 * by);
    grows(lattice.speed, 0.5 * by);
    const auto& respawn = std::get<RespawnGenerator>(large.generators[1]);
    moves(respawn.origin, {0, 7 * by, by});
    moves(respawn.size, {6, 3, 6});
    moves(respawn.velocity, {0, -4 * by, 0});
  }
}

TEST(Scaled, KeepsProportionsAndDropsExpectations) {
  const Scene pile = load_scene(file_of("pile"));
  const Scene eighth = scaled(pile, 0.125);
  EXPECT_EQ(expand(eighth).bodies.size(), 5u + 1000u);
  EXPECT_FALSE(eighth.expect.bodies.has_value());
  const auto& room = std::get<ContainerGenerator>(pile.generators[0]);
  const auto& smaller = std::get<ContainerGenerator>(eighth.generators[0]);
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(smaller.size[d], room.size[d] / 2, 1e-9);
  EXPECT_EQ(expand(scaled(pile, 1)).bodies.size(), 8005u);
  EXPECT_EQ(expand(scaled(pile, 1e-9)).bodies.size(), 6u);
  EXPECT_THROW(scaled(pile, 0), std::invalid_argument);
  EXPECT_THROW(scaled(pile, -1), std::invalid_argument);
}

}  // namespace
}  // namespace boxstream::scenes_test
