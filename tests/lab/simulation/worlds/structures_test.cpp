// SPDX-License-Identifier: MIT
// Large structures: a wall of 5050 boxes, and chains, a bridge and a net with the error of each of their joints.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "judge.hpp"
#include "sizes.hpp"

namespace boxstream::worlds_test {
namespace {

const btScalar half = btScalar(0.5);

std::string size_name(int steps) {
  return ", " + std::to_string(steps) + " steps";
}

/// How finely a step of 1/60 s is taken.
struct Fineness {
  int substeps = 1;
  int iterations = 10;
};

/// As Bullet has it, and the cheapest settings found with which a structure holds.
std::array<Fineness, 2> default_and(const Fineness& held) {
  return {Fineness{}, held};
}

std::string name_of(const Fineness& fineness) {
  if (fineness.substeps == 1 && fineness.iterations == 10) return "";
  return ", " + std::to_string(fineness.substeps) + (fineness.substeps == 1 ? " substep of " : " substeps of ") +
         std::to_string(fineness.iterations) + " iterations";
}

/// Takes steps of 1/60 s and calls `look()` after every tenth. Returns how many pairs were missed in these.
template <class Look>
std::size_t run(PlainWorld& world, int steps, const Fineness& fineness, Look look) {
  world.world->getSolverInfo().m_numIterations = fineness.iterations;
  std::size_t missed = 0;
  for (int i = 0; i < steps; ++i) {
    for (int k = 0; k < fineness.substeps; ++k) world.step(btScalar(1) / btScalar(60 * fineness.substeps));
    if (i % 10 != 0) continue;
    missed += world.missed_pairs();
    look();
  }
  return missed;
}

class Structures : public testing::TestWithParam<Kind> {};

// Quadratic time is for small worlds: see JointsOfChains.
INSTANTIATE_TEST_SUITE_P(All, Structures, testing::Values(Kind::subject, Kind::dbvt, Kind::dbvt_deferred, Kind::axis32),
                         [](const auto& test) { return test_name(test.param); });

TEST_P(Structures, PyramidOfBase100) {
  for (const Fineness& fineness : default_and({2, 10})) {
    PlainWorld world(GetParam());
    world.add(0, world.shape<btBoxShape>(btVector3(100, 1, 20)), btVector3(0, -1, 0));
    auto* box = world.shape<btBoxShape>(btVector3(half, half, half));
    for (int row = 0; row < 100; ++row)
      for (int i = 0; i < 100 - row; ++i)
        world.add(1, box, btVector3(btScalar(i) - half * btScalar(99 - row), half + btScalar(row), 0));
    ASSERT_EQ(world.bodies.size(), 5051u);
    const int steps = size_of_run(1000, 6);
    const std::size_t missed = run(world, steps, fineness, [] {});
    double height = 0;
    int fallen = 0;
    for (std::size_t i = 1; i < world.bodies.size(); ++i) {
      const btVector3& at = world.bodies[i]->getWorldTransform().getOrigin();
      height = std::max(height, double(at.y()) + 0.5);
      fallen += std::abs(at.z()) > half;
    }
    const double lost = 1 - height / 100;
    const std::string name = "wall of 5050" + name_of(fineness), size = size_name(steps);
    judge(name, "pairs missed == 0", GetParam(), static_cast<double>(missed), missed == 0, Asked::of_all, size);
    judge(name, "height lost, as a fraction < 0.01", GetParam(), lost, lost < 0.01, Asked::of_all, size);
    judge(name, "boxes out of the wall's plane == 0", GetParam(), fallen, fallen == 0, Asked::of_all, size);
    world.end_all_pairs();
  }
}

/// Two bodies, or one and the world, and the point that they share.
void join(PlainWorld& world, btRigidBody* a, btRigidBody& b, const btVector3& at) {
  const auto local = [&](const btRigidBody& body) { return body.getWorldTransform().inverse() * at; };
  if (a == nullptr)
    world.add(std::make_unique<btPoint2PointConstraint>(b, local(b)), true);
  else
    world.add(std::make_unique<btPoint2PointConstraint>(*a, b, local(*a), local(b)), false);
}

/// How far apart each joint's two points are, as a fraction of a link; the 99th of 100.
double joint_error(const PlainWorld& world, double link) {
  std::vector<double> errors;
  for (const auto& joint : world.joints) {
    const auto& ball = static_cast<const btPoint2PointConstraint&>(*joint);
    const btVector3 a = ball.getRigidBodyA().getCenterOfMassTransform() * ball.getPivotInA();
    const btVector3 b = ball.getRigidBodyB().getCenterOfMassTransform() * ball.getPivotInB();
    errors.push_back(double((a - b).length()) / link);
  }
  const auto place = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
  std::nth_element(errors.begin(), place, errors.end());
  return *place;
}

void judge_joints(PlainWorld& world, const std::string& name, Kind kind, double link, int steps,
                  const Fineness& fineness) {
  for (const auto& body : world.bodies)
    if (!body->isStaticObject()) body->setActivationState(DISABLE_DEACTIVATION);
  // At all times, for structures swing: at the end alone, chance decides.
  double error = 0;
  const std::size_t missed = run(world, steps, fineness, [&] { error = std::max(error, joint_error(world, link)); });
  const std::string world_name = name + name_of(fineness);
  judge(world_name, "pairs missed == 0", kind, static_cast<double>(missed), missed == 0, Asked::of_all,
        size_name(steps));
  judge(world_name, "greatest error of the joints, 99th of 100, as a fraction of a link < 0.05", kind, error,
        error < 0.05, Asked::of_all, size_name(steps));
  world.end_all_pairs();
}

class JointsOfChains : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(All, JointsOfChains, testing::ValuesIn(kinds),
                         [](const auto& test) { return test_name(test.param); });

void judge_chain(const std::string& name, int links, btScalar end_mass, Kind kind, const Fineness& fineness) {
  const double pitch = 0.5;
  PlainWorld world(kind);
  auto* link = world.shape<btCapsuleShape>(btScalar(0.1), btScalar(0.2));
  btRigidBody* former = nullptr;
  for (int i = 0; i < links; ++i) {
    btRigidBody& next = world.add(1, link, btVector3(0, btScalar(-pitch * (i + 0.5)), 0));
    join(world, former, next, btVector3(0, btScalar(-pitch * i), 0));
    former = &next;
  }
  if (end_mass > 0) {
    const btScalar end = btScalar(-pitch * links);
    btRigidBody& ball = world.add(end_mass, world.shape<btSphereShape>(half), btVector3(0, end - half, 0));
    join(world, former, ball, btVector3(0, end, 0));
  }
  judge_joints(world, name, kind, pitch, size_of_run(600, 600), fineness);
}

TEST_P(JointsOfChains, Hanging) {
  for (const Fineness& fineness : default_and({1, 50})) judge_chain("chain of 40", 40, 0, GetParam(), fineness);
  for (const Fineness& fineness : default_and({4, 20})) judge_chain("chain of 160", 160, 0, GetParam(), fineness);
  for (const Fineness& fineness : default_and({4, 20})) judge_chain("ball and chain", 40, 100, GetParam(), fineness);
}

TEST_P(JointsOfChains, Bridge) {
  for (const Fineness& fineness : default_and({8, 20})) {
    PlainWorld world(GetParam());
    constexpr int planks = 160;
    auto* plank = world.shape<btBoxShape>(btVector3(half, btScalar(0.125), 1));
    btRigidBody* former = nullptr;
    const btScalar sides[] = {-1, 1};
    for (int i = 0; i < planks; ++i) {
      btRigidBody& next = world.add(1, plank, btVector3(btScalar(i) + half, 0, 0));
      next.setDamping(btScalar(0.1), btScalar(0.1));
      // Two balls make a hinge, each with an error of its own.
      for (const btScalar side : sides) join(world, former, next, btVector3(btScalar(i), 0, side));
      former = &next;
    }
    for (const btScalar side : sides) join(world, nullptr, *former, btVector3(planks, 0, side));
    judge_joints(world, "bridge of 160", GetParam(), 1, size_of_run(600, 300), fineness);
  }
}

TEST_P(Structures, NetOf100By100) {
  for (const Fineness& fineness : default_and({8, 10})) {
    PlainWorld world(GetParam(), Room{btVector3(0, 0, 0), 400, 12000});
    const double spacing = 0.85;
    auto* node = world.shape<btSphereShape>(btScalar(0.4));
    for (int row = 0; row < 100; ++row)
      for (int i = 0; i < 100; ++i) {
        const btVector3 at(btScalar(spacing * (i - 49.5)), btScalar(-spacing * row), 0);
        btRigidBody& next = world.add(btScalar(0.27), node, at);
        next.setDamping(btScalar(0.05), 0);
        const auto to_former = [&](std::size_t back, const btVector3& way) {
          join(world, world.bodies[world.bodies.size() - 1 - back].get(), next, at + way * btScalar(spacing / 2));
        };
        if (i > 0) to_former(1, btVector3(-1, 0, 0));
        if (row > 0) to_former(100, btVector3(0, 1, 0));
        if (row == 0 && i >= 46 && i < 53) join(world, nullptr, next, at);
      }
    ASSERT_EQ(world.joints.size(), 19807u);
    judge_joints(world, "net of 100 x 100", GetParam(), spacing, size_of_run(200, 6), fineness);
  }
}

}  // namespace
}  // namespace boxstream::worlds_test
