// SPDX-License-Identifier: MIT
#include "users/bullet_games.hpp"

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleMesh.h>

#include <cmath>

namespace boxstream::bench {

namespace {

btVector3 at(double x, double y, double z) {
  return {btScalar(x), btScalar(y), btScalar(z)};
}

/// Its top is at height 0.
void add_ground(Game& game, double side) {
  game.add_body(game.box(side, 1, side), 0, at(0, -1, 0));
}

/// Something of a Game that goes round a place of its own, at two degrees a step.
struct Orbit {
  btCollisionObject* object;
  btVector3 centre;
  btScalar radius, start;

  void go(int step) const {
    const btScalar angle = start + btScalar(step) * btScalar(0.035);
    btTransform transform = object->getWorldTransform();
    transform.setOrigin(centre + radius * btVector3(std::cos(angle), 0, std::sin(angle)));
    object->setWorldTransform(transform);
    object->setInterpolationWorldTransform(transform);
    object->activate();
  }
};

Orbit orbit_of(Game& game, btCollisionObject* object, double radius) {
  return {object, object->getWorldTransform().getOrigin(), btScalar(radius), btScalar(game.random(0, 6.28))};
}

void drive(Game& game, std::vector<Orbit> orbits) {
  game.before_step([orbits = std::move(orbits)](int step) {
    for (const Orbit& orbit : orbits) orbit.go(step);
  });
}

void make_kinematic(btRigidBody& body) {
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  body.setActivationState(DISABLE_DEACTIVATION);
}

/// Crates side by side on a floor.
void build_rest(Game& game, int n) {
  const int side = int(std::ceil(std::sqrt(n)));
  add_ground(game, 2 * side + 10);
  btCollisionShape* const crate = game.box(0.5, 0.5, 0.5);
  for (int i = 0; i < n; ++i) game.add_body(crate, 1, at(1.2 * (i % side), 0.5, 1.2 * (i / side)));
  game.keep_awake();
}

/// Boxes and balls of several sizes in a bin.
void build_pile(Game& game, int n) {
  const double half = 0.55 * std::cbrt(n) + 0.5;
  add_ground(game, half + 2);
  const double wall = 4 * half;
  for (int side = -1; side <= 1; side += 2) {
    game.add_body(game.box(0.5, wall, half + 1), 0, at(side * (half + 0.5), wall, 0));
    game.add_body(game.box(half + 1, wall, 0.5), 0, at(0, wall, side * (half + 0.5)));
  }
  std::vector<btCollisionShape*> shapes;
  for (int i = 0; i < 4; ++i) {
    shapes.push_back(game.box(0.3 + 0.06 * i, 0.3, 0.42 - 0.04 * i));
    shapes.push_back(game.sphere(0.3 + 0.04 * i));
  }
  const int row = std::max(1, int((2 * half - 1) / 1.05));
  for (int i = 0; i < n; ++i) {
    const double x = (i % row - (row - 1) / 2.0) * 1.05, z = (i / row % row - (row - 1) / 2.0) * 1.05;
    game.add_body(shapes[std::size_t(game.random(0, 8))], 1,
                  at(x + game.random(-0.05, 0.05), 0.6 + 0.95 * (i / row / row), z + game.random(-0.05, 0.05)));
  }
  game.keep_awake();
}

/// Crates in stacks of five all over a town, asleep, and `movers` that drive about above them.
void build_town(Game& game, int n, int movers) {
  const int side = int(std::ceil(std::sqrt(n / 5.0)));
  add_ground(game, 3 * side + 10);
  btCollisionShape* const crate = game.box(0.5, 0.5, 0.5);
  for (int i = 0; i < n; ++i) {
    const int stack = i / 5;
    game.add_body(crate, 1, at(3 * (stack % side - side / 2), 0.5 + i % 5, 3 * (stack / side - side / 2)));
  }
  game.put_to_sleep();
  std::vector<Orbit> orbits;
  for (int i = 0; i < movers; ++i) {
    btRigidBody* const car =
        game.add_body(crate, 1, at(game.random(-1.5, 1.5) * side, 5.2, game.random(-1.5, 1.5) * side));
    make_kinematic(*car);
    orbits.push_back(orbit_of(game, car, 5));
  }
  drive(game, std::move(orbits));
}

void build_sleepers(Game& game, int n) {
  game.world().setForceUpdateAllAabbs(false);
  build_town(game, n, 20);
}

void build_town_of_few(Game& game, int n) {
  build_town(game, n, 20);
}

/// Hilly ground of about `triangles` triangles.
btCollisionShape* make_hills(Game& game, int triangles) {
  const int cells = int(std::sqrt(triangles / 2));
  auto* const mesh = game.own(std::make_unique<btTriangleMesh>());
  const auto point = [&](int x, int z) {
    return at(0.5 * (x - cells / 2), std::sin(0.11 * x) + std::cos(0.07 * z), 0.5 * (z - cells / 2));
  };
  for (int x = 0; x < cells; ++x) {
    for (int z = 0; z < cells; ++z) {
      mesh->addTriangle(point(x, z), point(x, z + 1), point(x + 1, z + 1));
      mesh->addTriangle(point(x, z), point(x + 1, z + 1), point(x + 1, z));
    }
  }
  return game.keep(std::make_unique<btBvhTriangleMeshShape>(mesh, true));
}

void build_mesh(Game& game, int n) {
  game.add_body(make_hills(game, 200000), 0, at(0, 0, 0));
  for (int i = 0; i < n; ++i)
    game.add_body(game.sphere(0.4), 1, at(game.random(-20, 20), 4 + game.random(0, 3), game.random(-20, 20)));
  game.keep_awake();
}

/// `n` bodies and as many ghosts among each other.
void build_ghosts(Game& game, int n) {
  const double half = 0.8 * std::cbrt(2 * n);
  btCollisionShape* const cube = game.box(0.5, 0.5, 0.5);
  std::vector<Orbit> orbits;
  for (int i = 0; i < n; ++i) {
    const auto anywhere = [&] {
      return at(game.random(-half, half), game.random(-half, half), game.random(-half, half));
    };
    btRigidBody* const body = game.add_body(cube, 1, anywhere());
    make_kinematic(*body);
    orbits.push_back(orbit_of(game, body, 2));
    orbits.push_back(orbit_of(game, game.add_ghost(cube, anywhere()), 2));
  }
  drive(game, std::move(orbits));
}

/// Sensors that stay where they are, a tenth as many as bodies that go through them.
void build_sensors(Game& game, int n) {
  const double half = std::sqrt(n);
  btCollisionShape* const zone = game.box(2, 2, 2);
  btCollisionShape* const cube = game.box(0.5, 0.5, 0.5);
  for (int i = 0; i < n / 10; ++i) game.add_ghost(zone, at(game.random(-half, half), 0, game.random(-half, half)));
  std::vector<Orbit> orbits;
  for (int i = 0; i < n; ++i) {
    btRigidBody* const body =
        game.add_body(cube, 1, at(game.random(-half, half), game.random(-1, 1), game.random(-half, half)));
    make_kinematic(*body);
    orbits.push_back(orbit_of(game, body, 3));
  }
  drive(game, std::move(orbits));
}

/// `n` characters that walk among 5000 posts.
void build_characters(Game& game, int n) {
  add_ground(game, 110);
  btCollisionShape* const post = game.box(0.3, 1.5, 0.3);
  for (int i = 0; i < 5000; ++i) game.add_body(post, 0, at(3 * (i % 71 - 35), 1.5, 3 * (i / 71 - 35)));
  for (int i = 0; i < n; ++i) {
    const double angle = game.random(0, 6.28);
    game.add_character(0.3, 1, at(3 * std::floor(game.random(-30, 30)) + 1.5, 0.9, game.random(-90, 90)),
                       at(1.5 * std::cos(angle), 0, 1.5 * std::sin(angle)));
  }
}

/// Accepts a pair if either side's mask names the other's group: the default of PyBullet's server.
struct EitherMask final : btOverlapFilterCallback {
  bool needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const override {
    return (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 ||
           (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0;
  }
};

/// `n` arms of eight links, each on a table, as PyBullet's server keeps them.
void build_robots(Game& game, int n) {
  game.world().setForceUpdateAllAabbs(false);
  game.pair_cache().setOverlapFilterCallback(game.own(std::make_unique<EitherMask>()));
  add_ground(game, 4 * std::sqrt(n) + 10);
  btCollisionShape* const table = game.box(0.6, 0.3, 0.6);
  btCollisionShape* const link = game.box(0.08, 0.2, 0.08);
  btCollisionShape* const part = game.box(0.06, 0.06, 0.06);
  const int side = int(std::ceil(std::sqrt(n)));
  for (int i = 0; i < n; ++i) {
    const btVector3 foot = at(3 * (i % side), 0, 3 * (i / side));
    btRigidBody* below = game.add_body(table, 0, foot + at(0, 0.3, 0));
    btScalar top = btScalar(0.3);
    for (int k = 0; k < 8; ++k) {
      btRigidBody* const above = game.add_body(link, 0.5, foot + at(0, 0.8 + 0.4 * k, 0));
      above->setActivationState(DISABLE_DEACTIVATION);
      auto* const joint = game.own(std::make_unique<btHingeConstraint>(
          *below, *above, btVector3(0, top, 0), at(0, -0.2, 0), at(k % 2, 0, 1 - k % 2), at(k % 2, 0, 1 - k % 2)));
      joint->enableAngularMotor(true, btScalar(game.random(-0.5, 0.5)), 100);
      game.world().addConstraint(joint, true);
      below = above;
      top = btScalar(0.2);
    }
    for (int k = 0; k < 4; ++k) game.add_body(part, 0.1, foot + at(0.35 - 0.2 * k, 0.7, 0.45));
  }
}

/// The hundred and twenty-five cubes of Bullet's first example.
void build_basic(Game& game, int n) {
  game.add_body(game.box(50, 50, 50), 0, at(0, -50, 0));
  const int side = int(std::round(std::cbrt(n)));
  btCollisionShape* const cube = game.box(0.1, 0.1, 0.1);
  for (int i = 0; i < n; ++i)
    game.add_body(cube, 1, at(0.2 * (i % side), 2 + 0.2 * (i / side / side), 0.2 * (i / side % side)));
}

/// Static bodies, some that move, and a thousand rays a step.
void build_rays(Game& game, int n) {
  build_sleepers(game, n);
  const double half = 1.5 * std::sqrt(n / 5.0);
  Game* const self = &game;
  std::vector<std::pair<btVector3, btVector3>> rays;
  for (int i = 0; i < 1000; ++i)
    rays.emplace_back(at(game.random(-half, half), 6, game.random(-half, half)),
                      at(game.random(-half, half), -0.5, game.random(-half, half)));
  game.cast_rays([self, rays = std::move(rays)] {
    for (const auto& [from, to] : rays) {
      btCollisionWorld::ClosestRayResultCallback closest(from, to);
      self->world().rayTest(from, to, closest);
    }
  });
}

}  // namespace

const std::vector<GameCase>& game_cases() {
  static const std::vector<GameCase> cases = {
      {"rest",
       "n crates at rest that are kept awake",
       build_rest,
       {10, 30, 100, 300, 1000},
       {10, 100, 300},
       0,
       0,
       false,
       true},
      {"awake", "the same as they are stepped", build_rest, {10, 30, 100, 300, 1000}, {10, 100, 300}, 60},
      {"pile",
       "n bodies in a bin, settled and kept awake",
       build_pile,
       {30, 100, 300, 1000, 3000, 10000},
       {100, 1000},
       400},
      {"sleepers",
       "n asleep, 20 move, boxes of sleeping ones are not set",
       build_sleepers,
       {1000, 5000, 20000, 50000},
       {5000}},
      {"town", "the same, with all boxes set in each step", build_town_of_few, {1000, 5000, 20000}, {5000}},
      {"mesh", "n balls on a mesh of 200 000 triangles", build_mesh, {10, 30, 100}, {30}, 60},
      {"ghosts", "n bodies and n ghosts, all moving", build_ghosts, {100, 1000, 3000}, {1000}},
      {"sensors", "n bodies through n/10 sensors", build_sensors, {100, 1000, 3000}, {1000}},
      {"characters", "n characters among 5000 posts", build_characters, {10, 100, 300}, {100}},
      {"characters:borrowed",
       "the same with a pair cache of the program's",
       build_characters,
       {10, 100, 300},
       {100},
       0,
       120,
       true},
      {"robots",
       "n arms as in PyBullet's server: a borrowed cache and a filter callback",
       build_robots,
       {1, 10, 100},
       {10},
       60,
       120,
       true},
      {"basic", "n cubes fall, as in Bullet's first example", build_basic, {27, 125, 1000}, {125}},
      {"rays", "1000 rays among n asleep and 20 that move", build_rays, {1000, 5000, 20000}, {5000}, 0, 40},
  };
  return cases;
}

}  // namespace boxstream::bench
