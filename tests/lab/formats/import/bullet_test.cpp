// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <btBulletDynamicsCommon.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "formats/import/import_file.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "original.hpp"
#include "sanitized.hpp"
#include "scratch_directory.hpp"
#include "simulation/run/simulation.hpp"
#include "solids.hpp"

namespace boxstream::import_test {
namespace {

using nlohmann::json;
using tool_test::ScratchDirectory;

json imported(Original& original) {
  const ScratchDirectory scratch;
  return json::parse(imports::import_file(scratch.write("world.bullet", original.bytes()), {}));
}

/// The scene that has nothing but the file in it.
scenes::Scene scene_of(const ScratchDirectory& scratch) {
  return scenes::parse_scene(
      R"({"format": 1, "meta": {"name": "copy", "about": "imported"}, "time": {"dt": 0.01},
  "world": {"gravity": [0, -5, 0], "bounds": {"min": [-50, -50, -50], "max": [50, 50, 50]}},
  "generators": [{"type": "import", "file": "world.bullet"}]})",
      scratch.file("scene.json"));
}

TEST(BulletFile, EveryBodyComesBack) {
  Original original;
  auto& compound = original.shape<btCompoundShape>();
  compound.addChildShape(btTransform(btQuaternion(0, 0, 0, 1), btVector3(0.5f, 0, 0)),
                         &original.shape<btSphereShape>(btScalar(0.25)));
  compound.addChildShape(btTransform(btQuaternion(0, 0, 0, 1), btVector3(-0.5f, 0, 0)),
                         &original.shape<btBoxShape>(btVector3(0.1f, 0.2f, 0.3f)));
  auto& hull = original.shape<btConvexHullShape>();
  for (const Vec3& v : tetrahedron().vertices) hull.addPoint(btVector3(btScalar(v[0]), btScalar(v[1]), btScalar(v[2])));
  auto& triangles = original.shape<btEmptyShape>();  // keeps the order of destruction plain
  (void)triangles;
  btTriangleMesh mesh;
  const TriangleMesh solid = tetrahedron();
  for (const auto& t : solid.triangles) {
    btVector3 v[3];
    for (std::size_t i = 0; i < 3; ++i)
      for (int d = 0; d < 3; ++d) v[i][d] = btScalar(solid.vertices[t[i]][static_cast<std::size_t>(d)]);
    mesh.addTriangle(v[0], v[1], v[2]);
  }
  // A coefficient that is multiplied by zero in every contact would be left out.
  original.body(0, original.shape<btStaticPlaneShape>(btVector3(0, 1, 0), btScalar(-1)), btVector3(0, 0, 0))
      .setRestitution(1);
  original.body(0, original.shape<btBvhTriangleMeshShape>(&mesh, true), btVector3(0, 0, 9));
  const btQuaternion turn(btVector3(1, 2, 3).normalized(), 1);
  original.body(2, original.shape<btBoxShape>(btVector3(0.5f, 0.25f, 1)), btVector3(1, 2, 3), turn);
  original.body(3, original.shape<btSphereShape>(btScalar(0.75)), btVector3(-3, 2, 0));
  original.body(4, original.shape<btCapsuleShapeZ>(btScalar(0.25), btScalar(1)), btVector3(0, 6, 0), turn);
  original.body(5, original.shape<btCylinderShapeX>(btVector3(1, 0.5f, 0.5f)), btVector3(5, 6, 0));
  original.body(6, original.shape<btConeShape>(btScalar(0.5), btScalar(1)), btVector3(9, 6, 0));
  original.body(7, compound, btVector3(0, 9, 0));
  btRigidBody& last = original.body(8, hull, btVector3(0, 12, 0));
  last.setLinearVelocity(btVector3(1, 0, -2));
  last.setAngularVelocity(btVector3(0, 3, 0));
  last.setDamping(btScalar(0.125), btScalar(0.25));
  last.setFriction(btScalar(0.75));
  last.setRestitution(btScalar(0.5));

  const ScratchDirectory scratch;
  scratch.write("world.bullet", original.bytes());
  scenes::Simulation copy(scene_of(scratch), "boxstream");
  ASSERT_EQ(copy.objects().size(), original.bodies().size());
  for (std::size_t i = 0; i < copy.objects().size(); ++i) {
    const btRigidBody &was = *original.bodies()[i], &is = *btRigidBody::upcast(copy.objects()[i]);
    const btTransform &from = was.getWorldTransform(), &to = is.getWorldTransform();
    EXPECT_LT(from.getOrigin().distance(to.getOrigin()), 1e-5f) << i;
    EXPECT_LT(from.getRotation().angleShortestPath(to.getRotation()), 1e-3f) << i;
    EXPECT_NEAR(was.getInvMass(), is.getInvMass(), 1e-6) << i;
    EXPECT_LT(was.getLinearVelocity().distance(is.getLinearVelocity()), 1e-5f) << i;
    EXPECT_LT(was.getAngularVelocity().distance(is.getAngularVelocity()), 1e-5f) << i;
    EXPECT_EQ(was.isStaticObject(), is.isStaticObject()) << i;

    const btVector3 &hard = was.getInvInertiaDiagLocal(), &as_hard = is.getInvInertiaDiagLocal();
    if (!is.isStaticOrKinematicObject()) {
      EXPECT_LT(hard.distance(as_hard), 1e-4f * hard.length()) << i;
    }

    // The shapes are where they were: up to the margins, which Bullet counts twice around hulls, and ours do not have.
    if (was.getCollisionShape()->getShapeType() == STATIC_PLANE_PROXYTYPE) continue;
    btVector3 low, high, low2, high2;
    was.getAabb(low, high);
    is.getAabb(low2, high2);
    const btVector3 at_low = low2 - low, at_high = high - high2;
    for (int d = 0; d < 3; ++d) {
      EXPECT_LT(std::abs(at_low[d]), 0.0801f) << i;
      EXPECT_LT(std::abs(at_high[d]), 0.0801f) << i;
    }
  }
  const btRigidBody& is = *btRigidBody::upcast(copy.objects().back());
  EXPECT_FLOAT_EQ(is.getLinearDamping(), 0.125f);
  EXPECT_FLOAT_EQ(is.getAngularDamping(), 0.25f);
  EXPECT_FLOAT_EQ(is.getFriction(), 0.75f);
  EXPECT_FLOAT_EQ(is.getRestitution(), 0.5f);
}

TEST(BulletFile, SaysItsGravityAndSharesShapes) {
  Original original;
  auto& box = original.shape<btBoxShape>(btVector3(1, 1, 1));
  original.body(1, box, btVector3(0, 0, 0));
  original.body(1, box, btVector3(0, 3, 0));
  const json all = imported(original);
  EXPECT_EQ(all["gravity"], json::parse("[0.0, -5.0, 0.0]"));
  EXPECT_EQ(all["shapes"].size(), 1u);
  EXPECT_EQ(all["bodies"].size(), 2u);
}

/// The scene decides: its world may have other things in it.
TEST(BulletFile, GravityThatAGeneratorLeavesOutIsNoted) {
  Original original;
  original.body(1, original.shape<btBoxShape>(btVector3(1, 1, 1)), btVector3(0, 0, 0));
  const auto notes = [&] {
    const ScratchDirectory scratch;
    scratch.write("world.bullet", original.bytes());
    return std::get<scenes::ImportGenerator>(scene_of(scratch).generators[0]).notes;
  };
  EXPECT_EQ(notes(), std::vector<std::string>{});
  original.world().setGravity(btVector3(0, -5, 1.5));
  EXPECT_EQ(notes(), std::vector<std::string>{"gravity of the file: left out"});
}

/// Lets the original and its copy run, and gives the largest distance between bodies that should be together.
double largest_difference(Original& original, int steps) {
  const ScratchDirectory scratch;
  scratch.write("world.bullet", original.bytes());
  scenes::Simulation copy(scene_of(scratch), "boxstream");
  double worst = 0;
  for (int step = 0; step < steps; ++step) {
    original.world().stepSimulation(btScalar(0.01), 0);
    copy.step();
    for (std::size_t i = 0; i < original.bodies().size(); ++i)
      worst = std::max(worst, double{original.bodies()[i]->getWorldTransform().getOrigin().distance(
                                  copy.objects()[i]->getWorldTransform().getOrigin())});
  }
  return worst;
}

class TwoBoxes : public testing::Test {
 protected:
  TwoBoxes() {
    auto& box = original.shape<btBoxShape>(btVector3(0.5f, 0.1f, 0.1f));
    a = &original.body(0, box, btVector3(0, 5, 0));
    b = &original.body(1, box, btVector3(1.2f, 5, 0));
    // Bullet's usual sleeping and our own differ in what they leave out.
    b->setActivationState(DISABLE_DEACTIVATION);
  }

  Original original;
  btRigidBody* a;
  btRigidBody* b;
};

TEST_F(TwoBoxes, OnABallJointMoveAsBefore) {
  original.join(std::make_unique<btPoint2PointConstraint>(*a, *b, btVector3(0.6f, 0, 0), btVector3(-0.6f, 0, 0)));
  EXPECT_LT(largest_difference(original, 100), 2e-3);
}

TEST_F(TwoBoxes, OnAHingeWithLimitsMoveAsBefore) {
  for (const bool reference_a : {false, true}) {
    SCOPED_TRACE(reference_a);
    auto& hinge = original.join(std::make_unique<btHingeConstraint>(
        *a, *b, btVector3(0.6f, 0, 0), btVector3(-0.6f, 0, 0), btVector3(0, 0, 1), btVector3(0, 0, 1), reference_a));
    hinge.setLimit(btScalar(-0.5), btScalar(0.75));
    const json joint = imported(original)["joints"].back();
    // It is the second body that moves, so angles change their sign; a hinge that looks from a has done so already.
    const double low = (reference_a ? -0.5 : -0.75) * 180 / std::numbers::pi;
    EXPECT_EQ(joint["a"], "body 1");
    EXPECT_NEAR(joint["limits"][0].get<double>(), low, 1e-3);
    if (reference_a) break;
  }
  EXPECT_LT(largest_difference(original, 150), 1e-2);
}

TEST_F(TwoBoxes, OnASliderMoveAsBefore) {
  b->setLinearVelocity(btVector3(1, 0, 0));
  const btTransform in_a(btQuaternion::getIdentity(), btVector3(0.6f, 0, 0));
  const btTransform in_b(btQuaternion::getIdentity(), btVector3(-0.6f, 0, 0));
  auto& slider = original.join(std::make_unique<btSliderConstraint>(*a, *b, in_a, in_b, true));
  slider.setLowerLinLimit(btScalar(-0.1));
  slider.setUpperLinLimit(btScalar(0.4));
  const json joint = imported(original)["joints"][0];
  EXPECT_EQ(joint["type"], "slider");
  EXPECT_NEAR(joint["limits"][1].get<double>(), 0.4, 1e-6);
  EXPECT_NEAR(joint["axis"][0].get<double>(), 1, 1e-6);
  EXPECT_LT(largest_difference(original, 100), 1e-2);
}

TEST_F(TwoBoxes, OnAFixedOr6DofOrConeTwistAreCarriedOver) {
  const btTransform in_a(btQuaternion::getIdentity(), btVector3(0.6f, 0, 0));
  const btTransform in_b(btQuaternion::getIdentity(), btVector3(-0.6f, 0, 0));
  original.join(std::make_unique<btFixedConstraint>(*a, *b, in_a, in_b));
  auto& cone = original.join(std::make_unique<btConeTwistConstraint>(*a, *b, in_a, in_b));
  cone.setLimit(btScalar(0.5), btScalar(0.5), btScalar(0.25));
  auto& free = original.join(std::make_unique<btGeneric6DofConstraint>(*a, *b, in_a, in_b, true));
  free.setLinearLowerLimit(btVector3(-1, 0, 1));
  free.setLinearUpperLimit(btVector3(2, 0, 0));
  free.setAngularLowerLimit(btVector3(0, 0, 0));
  free.setAngularUpperLimit(btVector3(0, 0, 0.5f));
  const json joints = imported(original)["joints"];
  ASSERT_EQ(joints.size(), 3u);
  EXPECT_EQ(joints[0]["type"], "fixed");
  EXPECT_EQ(joints[1]["type"], "cone_twist");
  EXPECT_NEAR(joints[1]["swing1"].get<double>(), 0.5 * 180 / std::numbers::pi, 1e-3);
  EXPECT_NEAR(joints[1]["twist"].get<double>(), 0.25 * 180 / std::numbers::pi, 1e-3);
  EXPECT_EQ(joints[2]["type"], "6dof");
  EXPECT_NEAR(joints[2]["linear"][0][0].get<double>(), -1, 1e-6);
  EXPECT_NEAR(joints[2]["linear"][0][1].get<double>(), 2, 1e-6);
  EXPECT_EQ(joints[2]["linear"][2], "free");
  EXPECT_NEAR(joints[2]["angular"][2][0].get<double>(), -0.5 * 180 / std::numbers::pi, 1e-3);
}

TEST_F(TwoBoxes, OnA6DofTurnToTheSameLimits) {
  const btTransform in_a(btQuaternion::getIdentity(), btVector3(0.6f, 0, 0));
  const btTransform in_b(btQuaternion::getIdentity(), btVector3(-0.6f, 0, 0));
  auto& free = original.join(std::make_unique<btGeneric6DofSpring2Constraint>(*a, *b, in_a, in_b));
  for (int axis = 0; axis < 6; ++axis) free.setLimit(axis, 0, 0);
  free.setLimit(5, btScalar(-0.2), btScalar(0.7));
  // It falls about the joint until it is at a limit, and there it stays.
  EXPECT_LT(largest_difference(original, 150), 1e-2);
}

TEST_F(TwoBoxes, WhatScenesHaveNoWordForIsNamed) {
  b->setLinearFactor(btVector3(1, 0, 1));
  original.join(std::make_unique<btGearConstraint>(*a, *b, btVector3(1, 0, 0), btVector3(1, 0, 0)));
  const json notes = imported(original)["notes"];
  std::string all;
  for (const json& line : notes) all += line.get<std::string>() + '\n';
  EXPECT_NE(all.find("linear or angular factors of bodies: 1 left out"), std::string::npos) << all;
  EXPECT_NE(all.find("constraints of type 10: 1 left out"), std::string::npos) << all;
}

std::string complaint(const std::string& bytes) {
  const ScratchDirectory scratch;
  const std::string path = scratch.write("w.bullet", bytes);
  try {
    imports::import_file(path, {});
  } catch (const scenes::SceneError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.substr(0, path.size() + 2), path + ": ");
    EXPECT_EQ(line.find('\n'), std::string::npos);
    return line.substr(path.size() + 2);
  }
  return {};
}

TEST_F(TwoBoxes, InABrokenFileAreRefusedWithOneLine) {
  const std::string good = original.bytes();
  EXPECT_EQ(complaint(good), "");
  EXPECT_EQ(complaint(""), "no .bullet file: it does not begin like one");
  EXPECT_EQ(complaint("BULLET"), "no .bullet file: it does not begin like one");
  EXPECT_EQ(complaint("{\"format\": 1}"), "no .bullet file: it does not begin like one");
  EXPECT_EQ(complaint(good.substr(0, 12)), "cut off after its header");
  EXPECT_NE(complaint(good.substr(0, good.size() / 2)), "");
  EXPECT_NE(complaint(good.substr(0, 12) + std::string(4000, '\xff')), "");
  EXPECT_NE(complaint(good.substr(0, 12) + std::string(4000, '\0')), "");
}

/// Bullet's reader trusts lengths and places in the file; this is what the child process is for.
TEST_F(TwoBoxes, InAFileWithWrongBytesNeverBringTheProgramDown) {
  const std::string good = original.bytes();
  std::uint64_t state = 3;
  const auto random = [&](std::size_t below) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return static_cast<std::size_t>((state >> 33) % below);
  };
  int refused = 0;
  for (int round = 0; round < (tests::sanitized ? 15 : 60); ++round) {
    std::string bad = good;
    // The first blocks are small and full of lengths and numbers.
    for (int i = 0; i < 4; ++i) bad[12 + random(2500)] = static_cast<char>(random(256));
    if (round % 5 == 0) bad.resize(random(bad.size()));
    refused += complaint(bad).empty() ? 0 : 1;
  }
  EXPECT_GT(refused, 0);
}

}  // namespace
}  // namespace boxstream::import_test
