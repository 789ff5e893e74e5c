// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "gallery.hpp"
#include "probe.hpp"

namespace boxstream::effects_test {
namespace {

/// One of Bullet's profile zones: which effects run it, and scenes of the gallery that must. No needs: every step does.
struct Zone {
  const char* name;
  Names needs;
  Names witnesses;
};

const std::vector<Zone>& zones() {
  const Names collide{"contacts", "sensors", "characters", "soft_bodies", "vehicles", "queries"};
  const Names swept{"ccd", "ccd_on_demand"};
  static const std::vector<Zone> all{
      {"internalSingleStepSimulation", {}, {"nothing"}},
      {"integrateTransforms", {}, {"nothing"}},
      {"calculateSimulationIslands", {}, {"nothing"}},
      {"solveConstraints", {}, {"nothing"}},
      {"updateActions", {}, {"nothing"}},
      {"islandUnionFindAndQuickSort", {}, {"nothing"}},
      {"processIslands", {}, {"nothing"}},
      {"solveGroup", {}, {"nothing"}},
      {"solveGroupCacheFriendlySetup", {}, {"nothing"}},
      {"solveGroupCacheFriendlyIterations", {}, {"nothing"}},
      {"solveGroupCacheFriendlySplitImpulseIterations", {}, {"nothing"}},
      {"solveGroupCacheFriendlyFinish", {}, {"nothing"}},
      {"solveSingleIteration", {}, {"nothing"}},
      {"convertBodies", {}, {"nothing"}},
      {"convertJoints", {}, {"nothing"}},
      {"performDiscreteCollisionDetection", collide, collide},
      {"updateAabbs", collide, collide},
      {"calculateOverlappingPairs", collide, collide},
      {"dispatchAllCollisionPairs", collide, collide},
      {"processAllOverlappingPairs", collide, collide},
      {"predictUnconstraintMotion",
       {"damping", "ccd", "ccd_on_demand", "soft_bodies"},
       {"damping", "ccd", "ccd_on_demand", "soft_bodies"}},
      {"btHashedOverlappingPairCache::processAllOverlappingPairs", {"characters"}, {"characters"}},
      {"btConvexConcaveCollisionAlgorithm::processCollision", {"meshes", "heightfields"}, {"meshes", "heightfields"}},
      {"btConvexTriangleCallback::processTriangle", {"meshes", "heightfields"}, {"meshes", "heightfields"}},
      {"processCollision (GJK?)", {"contacts"}, {"meshes"}},
      {"createPredictiveContacts", swept, swept},
      {"release predictive contact manifolds", swept, swept},
      {"predictive convexSweepTest", swept, swept},
      {"CCD motion clamping", swept, swept},
      {"m_storage.resize", {"other_solver"}, {"other_solver"}},
      {"storage=0", {"other_solver"}, {"other_solver"}},
      {"updateActivationState", {"sleeping"}, {"sleeping"}},
      {"btMultiBody addGravity", {"multibodies"}, {"multibodies"}},
      {"btMultiBody stepPositions", {"multibodies"}, {"multibodies"}},
      {"btMultiBody stepVelocities", {"multibodies"}, {"multibodies"}},
      {"btMultiBodyConstraintSolver::solveGroupCacheFriendlyFinish", {"multibodies"}, {"multibodies"}},
      {"warm starting write back", {"multibodies"}, {"multibodies"}},
      {"convexSweepTest", swept, swept},
      {"predictUnconstraintMotionSoftBody", {"soft_bodies"}, {"soft_bodies"}},
      {"PSolve_Anchors", {"soft_bodies"}, {"soft_bodies"}},
      {"PSolve_Links", {"soft_bodies"}, {"soft_bodies"}},
      {"PSolve_RContacts", {"soft_bodies"}, {"soft_bodies"}},
      {"PSolve_SContacts", {"soft_bodies"}, {"soft_bodies"}},
      {"btSoftBody::initializeFaceTree", {"soft_bodies"}, {"soft_bodies"}},
      {"SoftBody applyForces", {"soft_bodies"}, {"soft_bodies"}},
      {"ApplyClusters", {"soft_bodies"}, {"soft_bodies"}},
      {"UpdateClusters", {"soft_bodies"}, {"soft_bodies"}},
      {"Deformable Collision", {"soft_bodies"}, {}},
      {"solveSoftConstraints", {"soft_bodies"}, {"soft_bodies"}},
  };
  return all;
}

class ZonesOf : public testing::TestWithParam<Exhibit> {};

TEST_P(ZonesOf, AreThoseOfItsEffects) {
  const Names on = names_of(GetParam());
  const auto found = count_zones(exhibit(GetParam().name));
  for (const Zone& zone : zones()) {
    const bool entered = found.count(zone.name) > 0;
    const bool needed = std::any_of(zone.needs.begin(), zone.needs.end(),
                                    [&](const std::string& effect) { return on.count(effect) > 0; });
    if (!zone.needs.empty() && !needed) {
      EXPECT_FALSE(entered) << zone.name;
    }
    if (zone.witnesses.count(GetParam().name) > 0) {
      EXPECT_TRUE(entered) << zone.name;
    }
  }
  for (const auto& [name, times] : found) {
    const auto is_it = [&entered = name](const Zone& zone) { return entered == zone.name; };
    EXPECT_TRUE(std::any_of(zones().begin(), zones().end(), is_it))
        << "no row speaks of " << name << ", which was entered " << times << " times";
  }
}

INSTANTIATE_TEST_SUITE_P(Gallery, ZonesOf, testing::ValuesIn(gallery()),
                         [](const auto& test) { return name_of_exhibit(test.param); });

}  // namespace
}  // namespace boxstream::effects_test
