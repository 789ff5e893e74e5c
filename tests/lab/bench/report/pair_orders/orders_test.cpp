// SPDX-License-Identifier: MIT
#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

#include <btBulletDynamicsCommon.h>
#include <gtest/gtest.h>

#include "experiment_kinds/kinds.hpp"
#include "pair_orders/ordered.hpp"
#include "pair_orders/pair_sorter.hpp"

namespace boxstream::report {
namespace {

using Permutation = std::vector<std::uint32_t>;

/// Unit cubes: a floor, and above it a tower of `bodies` that overlap by a tenth of their height. Ids go from the top
/// to the bottom, and pairs are listed from the middle.
class Tower {
 public:
  explicit Tower(std::size_t bodies) : objects_(bodies + 1), proxies_(bodies + 1) {
    for (std::size_t i = 0; i <= bodies; ++i) {
      if (i > 0) objects_[i].setCollisionFlags(0);  // else static
      proxies_[i] = btBroadphaseProxy(at(i), at(i) + btVector3(1, 1, 1), &objects_[i], 1, 1);
      proxies_[i].m_uniqueId = static_cast<int>(bodies - i + 1);
    }
    for (std::size_t i = 0; i < bodies; ++i) pairs_.push_back((i + bodies / 2) % bodies);
  }

  /// Which bodies the pairs join with those above, in that order: 0 is the floor.
  Permutation sorted(const PairOrder& order) {
    PairSorter sorter(order, {0, -10, 0});
    return sorted(sorter);
  }
  Permutation sorted(PairSorter& sorter) {
    Permutation lower;
    const auto pair = [&](std::size_t i) { return std::pair(&proxies_[pairs_[i] + 1], &proxies_[pairs_[i]]); };
    for (const std::uint32_t i : sorter.sorted(pairs_.size(), pair))
      lower.push_back(static_cast<std::uint32_t>(pairs_[i]));
    return lower;
  }

 private:
  static btVector3 at(std::size_t i) { return {0, btScalar(i) * btScalar(0.9), 0}; }

  std::vector<btCollisionObject> objects_;
  std::vector<btBroadphaseProxy> proxies_;
  std::vector<std::size_t> pairs_;
};

const Permutation upwards{0, 1, 2, 3, 4, 5, 6}, downwards{6, 5, 4, 3, 2, 1, 0};

TEST(PairSorter, TakesPairsByWhatItsNameSays) {
  Tower tower(7);
  EXPECT_EQ(tower.sorted(parse_order("low first")), upwards);
  EXPECT_EQ(tower.sorted(parse_order("high first")), downwards);
  EXPECT_EQ(tower.sorted(parse_order("ground first")), upwards);
  EXPECT_EQ(tower.sorted(parse_order("curve")), upwards);  // which goes up, where there is but one axis
  EXPECT_EQ(tower.sorted(parse_order("ids")), downwards);
  EXPECT_THROW((void)parse_order("best"), std::invalid_argument);
}

TEST(PairSorter, ArbitraryOrdersAreFunctionsOfTheirSeed) {
  Tower tower(7);
  std::set<Permutation> orders;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const PairOrder order{PairOrder::By::random, seed};
    const Permutation once = tower.sorted(order);
    EXPECT_TRUE(std::is_permutation(once.begin(), once.end(), upwards.begin(), upwards.end()));
    EXPECT_EQ(tower.sorted(order), once);
    orders.insert(once);
  }
  EXPECT_GT(orders.size(), 15U);
  PairSorter shuffled(parse_order("shuffled"), {0, -10, 0});
  EXPECT_NE(tower.sorted(shuffled), tower.sorted(shuffled));
}

/// A stack of boxes that has not moved far: the height of its top, after some steps.
btVector3 top_of_stack(btConstraintSolver&& solver) {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btDiscreteDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  btBoxShape shape({btScalar(0.5), btScalar(0.5), btScalar(0.5)});
  btVector3 inertia;
  shape.calculateLocalInertia(1, inertia);
  std::vector<std::unique_ptr<btRigidBody>> bodies;
  for (int i = 0; i < 12; ++i) {
    bodies.push_back(std::make_unique<btRigidBody>(i == 0 ? 0 : 1, nullptr, &shape, inertia));
    bodies.back()->setWorldTransform(btTransform(btQuaternion::getIdentity(), {0, btScalar(i), 0}));
    world.addRigidBody(bodies.back().get());
  }
  for (int step = 0; step < 30; ++step) world.stepSimulation(btScalar(1) / 60, 0);
  const btVector3 top = bodies.back()->getWorldTransform().getOrigin();
  for (const auto& body : bodies) world.removeRigidBody(body.get());
  return top;
}

TEST(OrderedSolver, SolvesInItsOrder) {
  const btVector3 gravity(0, -10, 0);
  const auto in = [&](const char* name) { return top_of_stack(OrderedSolver(PairSorter(parse_order(name), gravity))); };
  const btVector3 plain = top_of_stack(btSequentialImpulseConstraintSolver()), low = in("low first"),
                  high = in("high first");
  for (const btVector3& top : {plain, low, high}) EXPECT_NEAR(double{top.y()}, 11, 0.2);
  EXPECT_TRUE(low == in("low first"));
  EXPECT_TRUE(low == in("ids"));  // created from below
  EXPECT_FALSE(low == high);
  EXPECT_FALSE(plain == low);
}

TEST(Orders, AnOrderThatNothingHasIsRefused) {
  Experiment experiment;
  experiment.file = "file.json";
  experiment.settings = {{"pairs", {"best"}}, {"solver", nlohmann::json::array()}, {"groups", nlohmann::json::array()}};
  experiment.kind = "orders";
  EXPECT_THROW((void)run_experiment(experiment, 1, [](const std::string&) {}), BadExperiment);
}

}  // namespace
}  // namespace boxstream::report
