// SPDX-License-Identifier: MIT
#include "pictures/viewer/film.hpp"

#include <gtest/gtest.h>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "glb_reader.hpp"
#include "mixed.hpp"

namespace boxstream::view {
namespace {

using view_test::GlbReader;

std::string glb_of(const Film& film) {
  std::ostringstream out;
  film.write(out);
  return out.str();
}

std::vector<float> place_of(const btTransform& pose) {
  const btVector3& p = pose.getOrigin();
  return {p.x(), p.y(), p.z()};
}

/// Distance of a rotation from that of a pose, whichever sign it has.
float distance(const std::vector<float>& rotation, const btTransform& pose) {
  const btQuaternion q = pose.getRotation();
  const float components[] = {q.x(), q.y(), q.z(), q.w()};
  float same = 0, opposite = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    same = std::max(same, std::fabs(rotation[k] - components[k]));
    opposite = std::max(opposite, std::fabs(rotation[k] + components[k]));
  }
  return std::min(same, opposite);
}

TEST(Film, IsWhereTheSimulationWasInEveryStep) {
  const scenes::Scene scene = view_test::mixed_scene();
  constexpr int steps = 90;
  scenes::Simulation simulation(scene, "boxstream");
  Film film(simulation, {steps, 0, "test"});
  ASSERT_EQ(film.every(), 1U);
  for (int i = 0; i < steps; ++i) {
    simulation.step();
    film.add_step();
  }
  const GlbReader glb(glb_of(film));

  scenes::Simulation again(scene, "boxstream");
  std::size_t compared = 0;
  std::size_t hidden = 0;
  for (int step = 0; step <= steps; ++step) {
    if (step > 0) again.step();
    const auto seconds = static_cast<float>(scene.time.dt * step);
    for (std::size_t i = 0; i < again.objects().size(); ++i) {
      const btCollisionObject& object = *again.objects()[i];
      if (object.getInternalType() == btCollisionObject::CO_SOFT_BODY) continue;
      const std::size_t node = glb.node("object " + std::to_string(i));
      ASSERT_EQ(glb.at(node, "translation", seconds), place_of(again.pose(i)))
          << "object " << i << " after step " << step;
      ASSERT_LT(distance(glb.at(node, "rotation", seconds), again.pose(i)), 1e-6F)
          << "object " << i << " after step " << step;
      const bool is_there = object.getBroadphaseHandle() != nullptr;
      if (!is_there) {
        ASSERT_EQ(glb.at(node, "scale", seconds), std::vector<float>(3, 0));
        ++hidden;
      }
      ++compared;
    }
  }
  EXPECT_EQ(compared, (steps + 1) * (again.objects().size() - 1));
  EXPECT_GT(hidden, 0U) << "the rain began to fall all at once";
}

TEST(Film, HasKeyframesOnlyWhereSomethingChanges) {
  const scenes::Scene scene = view_test::mixed_scene();
  scenes::Simulation simulation(scene, "boxstream");
  Film film(simulation, {60, 0, "test"});
  for (int i = 0; i < 60; ++i) {
    simulation.step();
    film.add_step();
  }
  const GlbReader glb(glb_of(film));
  std::size_t still = 0, moving = 0;
  for (std::size_t i = 0; i < simulation.objects().size(); ++i) {
    if (simulation.objects()[i]->getInternalType() == btCollisionObject::CO_SOFT_BODY) continue;
    const std::size_t node = glb.node("object " + std::to_string(i));
    if (simulation.objects()[i]->isStaticObject()) {
      EXPECT_FALSE(glb.is_animated(node, "translation") || glb.is_animated(node, "rotation"));
      ++still;
    } else if (glb.is_animated(node, "rotation")) {
      ++moving;
      // Neighbouring rotations are of the same sign, or the way from one to the next would be the long one.
      const std::vector<float> times = glb.times(node, "rotation");
      for (std::size_t k = 1; k < times.size(); ++k) {
        const std::vector<float> a = glb.at(node, "rotation", times[k - 1]);
        const std::vector<float> b = glb.at(node, "rotation", times[k]);
        EXPECT_GE(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3], 0);
      }
    }
  }
  EXPECT_GE(still, 3U);
  EXPECT_GE(moving, 90U);
}

TEST(Film, FormsAreShared) {
  scenes::Simulation simulation(view_test::mixed_scene(), "boxstream");
  const Model model = model_of(simulation);
  std::map<scenes::Drawable::Kind, std::size_t> forms, parts;
  for (const Form& form : model.forms) ++forms[form.kind];
  for (const Part& part : model.parts) ++parts[model.forms[part.form].kind];
  using Kind = scenes::Drawable::Kind;
  for (const Kind kind : {Kind::box, Kind::sphere, Kind::cylinder, Kind::cone, Kind::plane}) EXPECT_EQ(forms[kind], 1U);
  EXPECT_EQ(forms[Kind::capsule], 2U) << "the pills and the walker";
  EXPECT_GT(parts[Kind::capsule], 10U);
  // Hulls of the same points at different sizes are mostly, but not always, cut into the same triangles.
  EXPECT_GE(parts[Kind::triangles], 2 * forms[Kind::triangles]);
  Film film(simulation, {1, 0, "test"});
  simulation.step();
  film.add_step();
  const GlbReader glb(glb_of(film));
  EXPECT_LT(glb.document()["meshes"].size(), 60U);
}

TEST(Film, SoftBodiesAreShownOneStillAtATime) {
  const scenes::Scene scene = view_test::mixed_scene();
  constexpr int steps = 120;
  scenes::Simulation simulation(scene, "boxstream");
  Film film(simulation, {steps, 0, "test"});
  for (int i = 0; i < steps; ++i) {
    simulation.step();
    film.add_step();
  }
  const GlbReader glb(glb_of(film));
  const std::size_t cloth = glb.node("object " + std::to_string(simulation.objects().size() - 1));
  const auto& stills = glb.document()["nodes"][cloth]["children"];
  EXPECT_GT(stills.size(), 30U);
  EXPECT_LE(stills.size(), 61U);
  for (int step = 0; step <= steps; ++step) {
    float shown = 0;
    for (const std::size_t still : stills) shown += glb.at(still, "scale", static_cast<float>(scene.time.dt * step))[0];
    EXPECT_EQ(shown, 1) << "after step " << step;
  }
}

TEST(Film, EveryNthStepOnly) {
  const scenes::Scene scene = view_test::mixed_scene();
  scenes::Simulation simulation(scene, "boxstream");
  Film film(simulation, {30, 10, "test"});
  for (int i = 0; i < 30; ++i) {
    simulation.step();
    film.add_step();
  }
  const GlbReader glb(glb_of(film));
  const std::vector<float> times = glb.times(glb.node("object 3"), "translation");
  ASSERT_EQ(times.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(times[k], static_cast<float>(scene.time.dt * 10 * static_cast<double>(k)));
}

}  // namespace
}  // namespace boxstream::view
