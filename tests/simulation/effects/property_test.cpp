// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <BulletCollision/CollisionDispatch/btCollisionObject.h>
#include <algorithm>
#include <array>
#include <random>

#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

/// Scenes of the gallery in one, in this order, as far as they fit.
nlohmann::json all_of(const std::vector<std::size_t>& parts) {
  nlohmann::json document = document_of("nothing");
  for (const std::size_t part : parts)
    if (auto both = merged(document, document_of(gallery()[part].name))) document = std::move(*both);
  return document;
}

std::array<float, 7> place_of(const scenes::Simulation& simulation, std::size_t body) {
  const btTransform& at = simulation.objects()[body]->getWorldTransform();
  const btVector3 p = at.getOrigin();
  const btQuaternion q = at.getRotation();
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

/// Blocks of a scene that are lists of elements which call for something.
constexpr const char* blocks[] = {"bodies", "generators", "joints", "fields", "sensors", "queries", "soft_bodies"};

RC_GTEST_PROP(Plan, NeverLosesAnEffectWhenAnElementIsAdded, ()) {
  const auto parts = *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, gallery().size()));
  const nlohmann::json whole = all_of(parts);
  const Names with = on(effects::plan(scene_of(whole)));
  RC_CLASSIFY(with.size() > 6);
  for (const char* const block : blocks) {
    if (!whole.contains(block)) continue;
    nlohmann::json less = whole;
    less[block].erase(less[block].size() - 1);
    // What speaks of the element by name goes with it.
    if (block == std::string("bodies")) {
      less.erase("joints");
      less.erase("apart");
      less.erase("vehicles");
    }
    Names without = on(effects::plan(scene_of(less)));
    // A joint keeps its bodies from touching, and with that what contacts alone call for.
    if (block == std::string("joints"))
      for (const char* const effect : {"contacts", "friction", "anisotropic_friction", "rolling_friction",
                                       "spinning_friction", "restitution", "ccd_on_demand"})
        without.erase(effect);
    RC_ASSERT(std::includes(with.begin(), with.end(), without.begin(), without.end()));
    if (block == std::string("bodies")) continue;
    // Put back, and the plan is what it was.
    less[block].push_back(whole[block].back());
    RC_ASSERT(on(effects::plan(scene_of(less))) == with);
  }
}

RC_GTEST_PROP(Plan, GrowsWithEachSceneThatIsAdded, ()) {
  const auto parts = *rc::gen::container<std::vector<std::size_t>>(rc::gen::inRange<std::size_t>(0, gallery().size()));
  nlohmann::json document = document_of("nothing");
  Names before;
  for (const std::size_t part : parts) {
    auto both = merged(document, document_of(gallery()[part].name));
    if (!both) continue;
    document = std::move(*both);
    const Names after = on(effects::plan(scene_of(document)));
    RC_ASSERT(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    const Names own = names_of(gallery()[part]);
    RC_ASSERT(std::includes(after.begin(), after.end(), own.begin(), own.end()));
    before = after;
  }
}

// An effect that is off but should be on would change what happens.
TEST(Plan, LeavesNothingOutThatWouldChangeATrajectory) {
  // What Bullet is told to do or not by the scene itself; what makes boxes larger, and with that the order of pairs.
  const Names settings{"split_impulse", "friction_caching", "ccd", "forced_boxes"};
  std::mt19937 random(1);
  std::size_t compared = 0, off = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<std::size_t> parts(1 + random() % 8);
    for (std::size_t& part : parts) part = random() % gallery().size();
    nlohmann::json document = all_of(parts);
    // Each body a little elsewhere, so that no two scenes are alike.
    for (nlohmann::json& body : document["bodies"])
      if (body.value("type", "dynamic") == "dynamic" && body.contains("position"))
        for (nlohmann::json& x : body["position"]) x = x.get<double>() + 1e-3 * (random() % 100);
    const scenes::Scene scene = scene_of(document);
    const effects::Plan called = effects::plan(scene);
    effects::Plan more = called;
    for (effects::Decision& decision : more) {
      if (decision.on || settings.contains(decision.effect->name)) continue;
      decision.on = true;
      ++off;
    }
    scenes::Simulation plain(scene, "boxstream", {}, called), full(scene, "boxstream", {}, more);
    const std::size_t bodies = plain.census().bodies;
    for (int step = 0; step < 30; ++step) {
      plain.advance();
      full.advance();
      for (std::size_t body = 0; body < bodies; ++body) {
        ASSERT_EQ(place_of(plain, body), place_of(full, body))
            << "scene " << i << ", body " << body << ", step " << step << ": " << document.dump();
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 10000u);
  EXPECT_GT(off, 5000u);
}

}  // namespace
}  // namespace boxstream::effects_test
