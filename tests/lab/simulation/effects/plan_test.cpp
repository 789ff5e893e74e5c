// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include <btBulletDynamicsCommon.h>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/repeated.hpp"
#include "formats/scene_model/scene_error.hpp"
#include "gallery.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::effects_test {
namespace {

using effects::Decision;
using effects::Plan;
using nlohmann::json;

class PlanOf : public testing::TestWithParam<Exhibit> {};

TEST_P(PlanOf, IsExactlyTheGoldenOne) {
  std::map<std::string, std::string> expected, found;
  for (const Call& call : GetParam().calls) expected[call.effect] = call.pointer;
  for (const Decision& decision : effects::plan(exhibit(GetParam().name))) {
    EXPECT_EQ(decision.on, decision.call.has_value()) << decision.effect->name;
    if (!decision.call) continue;
    found[decision.effect->name] = decision.call->pointer;
    EXPECT_NE(decision.call->reason, "") << decision.effect->name;
  }
  EXPECT_EQ(found, expected);
}

template <class... T>
std::vector<std::string> kinds_of(const std::variant<T...>*) {
  return {T::kind...};
}

TEST(Plan, HasAnEffectForEachKindOfField) {
  const scenes::Field field;
  for (const std::string& kind : kinds_of(&field))
    EXPECT_TRUE(std::any_of(effects::all_effects().begin(), effects::all_effects().end(),
                            [&](const effects::Effect* effect) { return effect->name == kind; }))
        << kind;
}

TEST_P(PlanOf, NamesAnElementThatIsThere) {
  const json document = document_of(GetParam().name);
  EXPECT_EQ(GetParam().calls.empty(), GetParam().name == std::string("nothing"));
  for (const Call& call : GetParam().calls)
    EXPECT_TRUE(document.contains(json::json_pointer(call.pointer))) << call.effect << ": " << call.pointer;
}

INSTANTIATE_TEST_SUITE_P(Gallery, PlanOf, testing::ValuesIn(gallery()),
                         [](const auto& test) { return name_of_exhibit(test.param); });

TEST(Gallery, HasOneSceneForEachEffectAndOneForNone) {
  Names exhibits, expected{"nothing"}, files;
  for (const Exhibit& e : gallery()) {
    exhibits.insert(e.name);
    if (e.name != std::string("nothing")) {
      EXPECT_EQ(names_of(e).count(e.name), 1u) << e.name;
    }
  }
  for (const effects::Effect* effect : effects::all_effects()) expected.insert(effect->name);
  for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped("effects")))
    files.insert(entry.path().stem().string());
  EXPECT_EQ(exhibits, expected);
  EXPECT_EQ(files, expected);
}

TEST(Gallery, ManyTimesSideBySideCallsForTheSameAndContacts) {
  for (const Exhibit& e : gallery()) {
    const scenes::Scene once = exhibit(e.name);
    const scenes::Scene many = scenes::repeated(once, 9, 24);
    Names expected = names_of(e);
    expected.merge(Names{"contacts", "split_impulse"});  // of balls with balls
    EXPECT_EQ(on(effects::plan(many)), expected) << e.name;
    const scenes::Census one = scenes::Simulation(once, "boxstream").census();
    const scenes::Census nine = scenes::Simulation(many, "boxstream").census();
    if (once.generators.empty()) {
      const std::uint64_t planes = one.shapes[scenes::ShapeValue(scenes::PlaneShape{}).index()];
      EXPECT_EQ(nine.objects, 9 * (one.objects - planes) + planes) << e.name;
    }
    EXPECT_EQ(nine.joints, 9 * one.joints) << e.name;
    EXPECT_EQ(nine.soft_nodes, 9 * one.soft_nodes) << e.name;
  }
}

TEST(Gallery, StatesWhatItIsMadeOf) {
  for (const Exhibit& e : gallery()) {
    const scenes::Scene scene = exhibit(e.name);
    ASSERT_TRUE(scene.expect.objects) << e.name;
    EXPECT_EQ(scenes::check_expectations(scene, scenes::Simulation(scene, "boxstream").census()), "");
  }
}

TEST(Gallery, RunsWithEverythingBuiltAsWell) {
  for (const Exhibit& e : gallery()) {
    scenes::Simulation all(exhibit(e.name), "boxstream", {}, effects::Extent::all);
    for (int i = 0; i < 20; ++i) all.advance();
    EXPECT_TRUE(all.is_finite()) << e.name;
  }
}

/// Shipped scenes, smaller.
TEST(ShippedScenes, RunWithEverythingBuilt) {
  for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped())) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".json" || name.starts_with("query_")) continue;
    scenes::Scene scene = scenes::scaled(scenes::load_scene(entry.path().string()), 0.02);
    scene.time.warmup_steps = 0;
    scenes::Simulation all(scene, "boxstream", {}, effects::Extent::all);
    for (int i = 0; i < 4; ++i) all.advance();
    EXPECT_TRUE(all.is_finite()) << name;
    EXPECT_EQ(on(all.plan()).size(), effects::all_effects().size());
  }
}

/// Multibodies have the one body of these scenes, which is neither swept nor tumbled then; and some things cannot be in
/// a world with them.
void leave_out_by_multibodies(Names& names) {
  if (names.count("multibodies") == 0) return;
  if (names.count("soft_bodies") + names.count("out_of_bounds") + names.count("conveyors") +
          names.count("bounces_on_contact") >
      0) {
    names.erase("multibodies");
    return;
  }
  names.erase("gyroscopic");
  if (names.erase("ccd") > 0) names.erase("ccd_on_demand");
}

TEST(Plan, OfTwoScenesInOneIsTheUnionOfTheirPlans) {
  int pairs = 0, conflicts = 0;
  const std::vector<Exhibit>& all = gallery();
  std::vector<json> documents;
  for (const Exhibit& e : all) documents.push_back(document_of(e.name));
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const auto both = merged(documents[i], documents[j]);
      if (!both) {
        ++conflicts;
        continue;
      }
      ++pairs;
      Names expected = names_of(all[i]);
      expected.merge(names_of(all[j]));
      leave_out_by_multibodies(expected);
      EXPECT_EQ(on(effects::plan(scene_of(*both))), expected) << all[i].name << " and " << all[j].name;
    }
  EXPECT_EQ(pairs + conflicts, 48 * 47 / 2);
  EXPECT_GT(pairs, 750);
}

TEST(Plan, OfEverythingHasEverythingOnAndStillSaysWhatIsCalledFor) {
  const Plan all = effects::plan(exhibit("wind"), effects::Extent::all);
  EXPECT_EQ(on(all).size(), effects::all_effects().size());
  for (const Decision& decision : all)
    EXPECT_EQ(decision.call.has_value(), std::string("wind") == decision.effect->name) << decision.effect->name;
}

std::string complaint_about(const json& wishes, const char* exhibit = "wind") {
  json document = document_of(exhibit);
  document["effects"] = wishes;
  try {
    effects::plan(scene_of(document));
    return "";
  } catch (const scenes::SceneError& error) {
    return error.what();
  }
}

TEST(Wishes, ThatComeTrueChangeNothing) {
  EXPECT_EQ(complaint_about({{"require", {"wind"}}, {"forbid", {"drag", "contacts"}}}), "");
}

TEST(Wishes, AreErrorsIfTheSceneDoesNotAgree) {
  EXPECT_EQ(complaint_about({{"require", {"wind", "drag"}}}), "wind: /effects/require/1: nothing calls for \"drag\"");
  EXPECT_EQ(complaint_about({{"forbid", {"drag", "wind"}}}),
            "wind: /effects/forbid/1: \"wind\" is called for by /fields/0 (wind)");
  EXPECT_EQ(complaint_about({{"forbid", {"friction"}}}, "rolling_friction"),
            "rolling_friction: /effects/forbid/0: \"friction\" is called for by /bodies/0 (friction 0.5)");
  EXPECT_EQ(complaint_about({{"require", {"magic"}}})
                .find("wind: /effects/require/0: unknown effect 'magic'; there are "
                      "gravity, tumbling_gravity, contacts, "),
            0u);
}

TEST(Wishes, AreNotAskedForWhenEverythingIsBuilt) {
  json document = document_of("wind");
  document["effects"] = {{"forbid", {"wind"}}};
  EXPECT_NO_THROW(effects::plan(scene_of(document), effects::Extent::all));
}

/// What a scene of two bodies that meet calls for, after a change.
bool calls_for(const char* effect, const char* exhibit, const std::vector<json>& patch = {}) {
  return on(effects::plan(scene_of(document_of(exhibit).patch(patch)))).contains(effect);
}
json set_to(const char* pointer, const json& value) {
  return {{"op", "add"}, {"path", pointer}, {"value", value}};
}
json put(const char* pointer, const json& value) {
  return {{"op", "replace"}, {"path", pointer}, {"value", value}};
}

// Bullet multiplies the coefficients of the two bodies of a contact.
TEST(Plan, LeavesOutWhatTheOtherBodyMakesZero) {
  EXPECT_TRUE(calls_for("restitution", "restitution"));
  EXPECT_FALSE(calls_for("restitution", "restitution", {set_to("/bodies/1/material", "smooth")}));
  for (const char* const effect : {"friction", "rolling_friction", "spinning_friction", "anisotropic_friction"}) {
    EXPECT_TRUE(calls_for(effect, effect)) << effect;
    EXPECT_TRUE(calls_for("contacts", effect)) << effect;
    std::vector<json> patch;
    const json document = document_of(effect);
    for (std::size_t i = 0; i < document["bodies"].size(); ++i)
      if (document["bodies"][i].value("type", "dynamic") == "static")
        patch.push_back(set_to(("/bodies/" + std::to_string(i) + "/material").c_str(), "smooth"));
    ASSERT_FALSE(patch.empty()) << effect;
    EXPECT_FALSE(calls_for(effect, effect, patch)) << effect;
    EXPECT_TRUE(calls_for("contacts", effect, patch)) << effect;
  }
}

// Bullet's characters have a friction that no scene sets, and are in the way as fixed bodies are.
TEST(Plan, HasTheFrictionsOfABodyThatCharactersRub) {
  const json walker = set_to("/characters", json::array({{{"path", {{0, 1, 3}}}}}));
  for (const char* const effect : {"friction", "rolling_friction", "spinning_friction", "anisotropic_friction"}) {
    const json document = document_of(effect);
    std::vector<json> patch{walker}, masked;
    for (std::size_t i = 0; i < document["bodies"].size(); ++i) {
      const std::string body = "/bodies/" + std::to_string(i);
      if (document["bodies"][i].value("type", "dynamic") == "static")
        patch.push_back(set_to((body + "/material").c_str(), "smooth"));
      else
        masked.push_back(set_to((body + "/mask").c_str(), 1));
    }
    masked.insert(masked.end(), patch.begin(), patch.end());
    EXPECT_TRUE(calls_for(effect, effect, patch)) << effect;
    EXPECT_FALSE(calls_for(effect, effect, masked)) << effect << ": it does not meet them";
    patch.erase(patch.begin());
    EXPECT_FALSE(calls_for(effect, effect, patch)) << effect << ": on ice alone";
  }
}

TEST(Plan, LeavesOutWhatHasNothingToActOn) {
  const json apart = set_to("/exclusions", json::array({json::array({"ball", "ground"})}));
  const auto left_out = [](const char* effect, const std::vector<json>& patch) {
    return calls_for(effect, effect) && !calls_for(effect, effect, patch);
  };
  EXPECT_TRUE(left_out("split_impulse", {apart}));
  EXPECT_TRUE(left_out("friction_caching", {apart}));
  EXPECT_TRUE(left_out("friction_caching", {set_to("/bodies/1/material", "smooth")}));
  EXPECT_TRUE(left_out("forced_boxes", {apart}));
  EXPECT_TRUE(left_out("exclusions", {set_to("/bodies/0/group", 2), set_to("/bodies/0/mask", 4)})) << "they never meet";
  EXPECT_TRUE(left_out("motors", {put("/joints/0/motor/max_force", 0)}));
  EXPECT_TRUE(left_out("wind", {set_to("/fields/0/density", 0)}));
  EXPECT_TRUE(left_out("drag", {put("/fields/0", {{"type", "drag"}})}));
  EXPECT_TRUE(left_out("buoyancy", {set_to("/fields/0/density", 0), set_to("/fields/0/drag", 0)}));
  EXPECT_TRUE(left_out("vortex", {put("/fields/0/rate", 0)}));
}

TEST(Plan, OfBodiesThatExcludeEachOtherHasNoContacts) {
  EXPECT_FALSE(
      calls_for("contacts", "contacts", {set_to("/exclusions", json::array({json::array({"ball", "ground"})}))}));
  EXPECT_FALSE(
      calls_for("friction", "friction", {set_to("/exclusions", json::array({json::array({"ball", "ground"})}))}));
  // Two balls on a hinge, first alone.
  json other = document_of("contacts")["bodies"][0];
  other["name"] = "other";
  const json ground = document_of("contacts")["bodies"][1];
  json hinge = {{"type", "hinge"}, {"a", "ball"}, {"b", "other"}, {"pivot", {0, 2, 0}}, {"axis", {1, 0, 0}}};
  const auto patch = [&] {
    return std::vector<json>{{{"op", "replace"}, {"path", "/bodies/1"}, {"value", other}},
                             set_to("/joints", json::array({hinge}))};
  };
  EXPECT_FALSE(calls_for("contacts", "contacts", patch()));
  std::vector<json> with_ground = patch();
  with_ground.push_back(set_to("/bodies/-", ground));
  EXPECT_TRUE(calls_for("contacts", "contacts", with_ground));
  hinge["collide"] = true;
  EXPECT_TRUE(calls_for("contacts", "contacts", patch()));
}

// What could come to move too far in a step for its thickness and that of what it can touch.
TEST(Plan, SweepsOnDemandWhereSomethingThinCanBeInTheWay) {
  const auto sweeps = [](std::vector<json> patch) {
    patch.push_back(set_to("/world/ccd", patch.empty() || patch[0]["path"] != "/world/ccd"));
    return calls_for("ccd_on_demand", "contacts", patch);
  };
  const json plane = put("/shapes/1", {{"name", "ground"}, {"type", "plane"}, {"normal", {0, 1, 0}}});
  const json another = {{"name", "other"}, {"shape", "ball"}, {"mass", 1}, {"position", {3, 12, 0}}};
  EXPECT_TRUE(sweeps({}));
  EXPECT_FALSE(sweeps({set_to("/world/ccd", false)}));
  EXPECT_FALSE(sweeps({set_to("/bodies/0/ccd", false)}));
  EXPECT_TRUE(sweeps({set_to("/world/gravity", {0, 0, 0})})) << "it glides";
  EXPECT_TRUE(sweeps({set_to("/world/gravity", {0, 0, 0}), set_to("/bodies/0/velocity", {0, 0, 0})}))
      << "what overlaps is pushed apart";
  EXPECT_FALSE(sweeps({plane})) << "a half-space is as thick as can be";
  EXPECT_TRUE(sweeps({plane, set_to("/bodies/-", another)})) << "two balls";
  EXPECT_FALSE(sweeps({set_to("/bodies/0/group", 2), set_to("/bodies/0/mask", 2)})) << "they do not meet";
}

TEST(Plan, HasTheGyroscopicTermWhereAnUnevenBodyCanBeHitOrDriven) {
  const auto tumbles = [](const std::vector<json>& patch) { return calls_for("gyroscopic", "contacts", patch); };
  const json brick = put("/shapes/0", {{"name", "ball"}, {"type", "box"}, {"half_extents", {0.5, 0.4, 0.3}}});
  const json cube = put("/shapes/0", {{"name", "ball"}, {"type", "box"}, {"half_extents", {0.5, 0.5, 0.5}}});
  const json joint = {{"type", "ball"}, {"a", "ball"}, {"pivot", {0, 3, 0}}};
  const json alone = {{"op", "remove"}, {"path", "/bodies/1"}};
  EXPECT_FALSE(tumbles({})) << "a ball";
  EXPECT_FALSE(tumbles({cube}));
  EXPECT_TRUE(tumbles({brick})) << "the ground can hit it";
  EXPECT_FALSE(tumbles({brick, alone})) << "nothing can";
  EXPECT_TRUE(tumbles({brick, alone, set_to("/joints", json::array({joint}))}));
  EXPECT_TRUE(tumbles({brick, alone, set_to("/bodies/0/spin", {0, 1, 0})}));
  EXPECT_FALSE(tumbles({brick, set_to("/bodies/0/gyro", false)}));
  EXPECT_TRUE(tumbles({brick, alone, set_to("/bodies/0/gyro", true)})) << "given";
  EXPECT_FALSE(tumbles({set_to("/bodies/0/gyro", true)})) << "a ball has none";
  const json no_wish = {{"op", "remove"}, {"path", "/bodies/2/gyro"}}, unmet = set_to("/bodies/2/mask", 64);
  EXPECT_TRUE(calls_for("gyroscopic", "vehicles", {no_wish, unmet})) << "nothing hits the chassis, its wheels turn it";
}

TEST(Plan, OfEverythingHasTheGyroscopicTermForBodiesThatDoNotCallForIt) {
  scenes::Simulation all(scene_of(document_of("gravity").patch(std::vector<json>{put(
                             "/shapes/0", {{"name", "ball"}, {"type", "box"}, {"half_extents", {0.5, 0.4, 0.3}}})})),
                         "boxstream", {}, effects::Extent::all);
  EXPECT_FALSE(calls_for("gyroscopic", "gravity"));
  btRigidBody& body = *btRigidBody::upcast(all.objects()[0]);
  const btVector3 spin(3, 5, 1);
  body.setAngularVelocity(spin);
  all.advance();
  EXPECT_GT((body.getAngularVelocity() - spin).length(), 0.01) << "it tumbles";
}

TEST(Plan, OfStaticBodiesHasNothingThatMoves) {
  for (const char* const effect : {"gravity", "tumbling_gravity", "wind", "drag", "buoyancy", "vortex", "impulses",
                                   "damping", "friction", "restitution", "contacts", "split_impulse",
                                   "friction_caching", "forced_boxes", "exclusions", "out_of_bounds"}) {
    json document = document_of(effect);
    for (json& body : document["bodies"]) {
      for (const char* const of_dynamic : {"mass", "density", "velocity", "spin"}) body.erase(of_dynamic);
      body["type"] = "static";
    }
    document.erase("expect");
    EXPECT_EQ(on(effects::plan(scene_of(document))), Names{}) << effect;
  }
}

/// What each shipped scene calls for.
const std::map<std::string, Names> golden{
    {"arm",
     {"gravity", "contacts", "friction", "rolling_friction", "split_impulse", "sleeping", "gyroscopic", "planes",
      "meshes", "compounds", "joints", "joint_limits", "motors", "exclusions", "ccd_on_demand", "unit_contacts"}},
    {"bin_picking",
     {"gravity", "contacts", "friction", "rolling_friction", "restitution", "split_impulse", "sleeping", "gyroscopic",
      "planes", "compounds", "ccd_on_demand", "unit_contacts"}},
    {"box3d_joint_grid",
     {"gravity", "contacts", "friction", "split_impulse", "damping", "sleeping", "joints", "ccd_on_demand"}},
    {"box3d_large_pyramid", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "ccd_on_demand"}},
    {"box3d_large_world",
     {"gravity", "contacts", "friction", "rolling_friction", "restitution", "split_impulse", "sleeping",
      "ccd_on_demand"}},
    {"box3d_many_pyramids", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "ccd_on_demand"}},
    {"box3d_rain",
     {"gravity", "contacts", "friction", "restitution", "split_impulse", "ccd", "sleeping", "gyroscopic", "respawn",
      "ccd_on_demand"}},
    {"box3d_washer",
     {"gravity", "contacts", "friction", "split_impulse", "sleeping", "kinematic", "compounds", "ccd_on_demand"}},
    {"broadmark_brownian_assorted",
     {"contacts", "friction", "split_impulse", "sleeping", "gyroscopic", "impulses", "out_of_bounds"}},
    {"broadmark_brownian_cubes", {"contacts", "friction", "split_impulse", "sleeping", "impulses", "out_of_bounds"}},
    {"broadmark_brownian_spheres", {"contacts", "friction", "split_impulse", "sleeping", "impulses", "out_of_bounds"}},
    {"broadmark_fall_assorted",
     {"gravity", "contacts", "friction", "split_impulse", "sleeping", "gyroscopic", "out_of_bounds"}},
    {"broadmark_fall_cubes", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "out_of_bounds"}},
    {"broadmark_fall_spheres", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "out_of_bounds"}},
    {"broadmark_gravity_assorted",
     {"tumbling_gravity", "contacts", "friction", "split_impulse", "sleeping", "gyroscopic", "out_of_bounds"}},
    {"broadmark_gravity_cubes",
     {"tumbling_gravity", "contacts", "friction", "split_impulse", "sleeping", "out_of_bounds"}},
    {"broadmark_gravity_spheres",
     {"tumbling_gravity", "contacts", "friction", "split_impulse", "sleeping", "out_of_bounds"}},
    {"bullet1", {"gravity", "contacts", "friction", "split_impulse", "sleeping"}},
    {"bullet2", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "gyroscopic"}},
    {"bullet3",
     {"gravity", "contacts", "friction", "split_impulse", "damping", "sleeping", "gyroscopic", "joints",
      "joint_limits"}},
    {"bullet4", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "gyroscopic"}},
    {"bullet5", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "gyroscopic", "meshes"}},
    {"bullet6", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "gyroscopic", "meshes"}},
    {"bullet7", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "gyroscopic", "meshes", "queries"}},
    {"bullet8", {"gravity", "contacts", "friction", "split_impulse", "sleeping", "gyroscopic", "planes"}},
    {"character",
     {"gravity", "contacts", "friction", "split_impulse", "damping", "sleeping", "gyroscopic", "kinematic", "joints",
      "joint_limits", "sensors", "characters", "ccd_on_demand"}},
    {"cloth",
     {"gravity", "contacts", "friction", "rolling_friction", "split_impulse", "sleeping", "soft_bodies",
      "ccd_on_demand"}},
    {"hopper",
     {"gravity", "contacts", "friction", "rolling_friction", "restitution", "split_impulse", "sleeping",
      "ccd_on_demand"}},
    {"jolt_convex_vs_mesh",
     {"gravity", "contacts", "friction", "rolling_friction", "split_impulse", "sleeping", "gyroscopic", "meshes"}},
    {"jolt_high_speed", {"contacts", "friction", "restitution", "split_impulse", "ccd", "gyroscopic", "ccd_on_demand"}},
    {"jolt_pyramid", {"gravity", "contacts", "friction", "split_impulse"}},
    {"jolt_ragdoll_piles",
     {"gravity", "contacts", "friction", "restitution", "split_impulse", "damping", "sleeping", "gyroscopic", "joints",
      "joint_limits"}},
    {"pile",
     {"gravity", "contacts", "friction", "rolling_friction", "restitution", "split_impulse", "sleeping", "gyroscopic"}},
    {"ragdolls",
     {"gravity", "contacts", "friction", "restitution", "split_impulse", "damping", "ccd", "sleeping", "gyroscopic",
      "planes", "joints", "joint_limits", "ccd_on_demand"}},
    {"storm", {"gravity", "contacts", "friction", "restitution", "split_impulse", "gyroscopic", "vortex"}},
    {"terrain",
     {"gravity", "contacts", "friction", "rolling_friction", "spinning_friction", "restitution", "split_impulse",
      "damping", "ccd", "sleeping", "gyroscopic", "meshes", "heightfields", "compounds", "ccd_on_demand",
      "unit_contacts"}},
    {"wall",
     {"gravity", "contacts", "friction", "restitution", "split_impulse", "damping", "sleeping", "gyroscopic", "joints",
      "ccd_on_demand"}},
};

TEST(Plan, OfEachShippedSceneIsTheGoldenOne) {
  std::size_t found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(scenes::shipped())) {
    const std::string name = entry.path().stem().string();
    // Scenes of queries have no effects.
    if (entry.path().extension() != ".json" || name.starts_with("query_")) continue;
    ++found;
    ASSERT_TRUE(golden.contains(name)) << name;
    EXPECT_EQ(on(effects::plan(scenes::load_scene(entry.path().string()))), golden.at(name)) << name;
  }
  EXPECT_EQ(found, golden.size());
}

}  // namespace
}  // namespace boxstream::effects_test
