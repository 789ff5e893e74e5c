// SPDX-License-Identifier: MIT
#include "golden.hpp"
#include "plain_world.hpp"

namespace boxstream::worlds_test {
namespace {

const btScalar half = btScalar(0.5);

void stack(PlainWorld& world) {
  world.add_ground();
  auto* plate = world.shape<btBoxShape>(btVector3(half, btScalar(0.25), 1));
  for (int i = 0; i < 10; ++i)
    world.add(1, plate, btVector3(0, btScalar(0.25) + half * btScalar(i), 0),
              i % 2 ? btQuaternion(btVector3(0, 1, 0), SIMD_HALF_PI) : btQuaternion::getIdentity());
}

void heap(PlainWorld& world) {
  world.add_ground();
  Random random(22);
  btCollisionShape* const shapes[] = {
      world.shape<btBoxShape>(btVector3(half, half, half)), world.shape<btSphereShape>(half),
      world.shape<btCapsuleShape>(btScalar(0.3), btScalar(0.6)), world.shape<btConeShape>(half, 1)};
  for (int i = 0; i < 120; ++i) {
    const btScalar z = random.real(-2, 2), x = random.real(-2, 2);  // one by one, in the order of the recorded run
    world.add(1, shapes[i % 4], btVector3(x, btScalar(0.6) + btScalar(i) / 8, z));
  }
}

void chain(PlainWorld& world) {
  auto* link = world.shape<btCapsuleShape>(btScalar(0.1), btScalar(0.2));
  for (int i = 0; i < 40; ++i) {
    btRigidBody& next = world.add(1, link, btVector3(btScalar(i) * half, 0, 0));
    const btVector3 end(btScalar(-0.25), 0, 0);
    if (i == 0)
      world.add(std::make_unique<btPoint2PointConstraint>(next, end), true);
    else
      world.add(
          std::make_unique<btPoint2PointConstraint>(*world.bodies[static_cast<std::size_t>(i) - 1], next, -end, end),
          false);
  }
}

struct World {
  const char* name;
  void (*build)(PlainWorld&);
};

constexpr World worlds[] = {{"world/chain", chain}, {"world/heap", heap}, {"world/stack", stack}};

}  // namespace

std::vector<std::string> golden_names() {
  std::vector<std::string> names;
  for (const World& world : worlds) names.emplace_back(world.name);
  return names;
}

std::string golden_line(const std::string& name) {
  constexpr int steps = 120;
  PlainWorld world(Kind::subject);
  for (const World& known : worlds)
    if (name == known.name) known.build(world);
  Fold pairs, states;
  for (int i = 0; i < steps; ++i) {
    world.step();
    for (const bullet_test::UidPair& pair : bullet_test::pairs_of(*world.broadphase))
      pairs.add(static_cast<std::uint64_t>(pair.first) << 32 | static_cast<std::uint64_t>(pair.second));
    pairs.add(0);
    states.add(world.state_hash());
  }
  return golden_line(name, precision(), steps, pairs, states);
}

}  // namespace boxstream::worlds_test
