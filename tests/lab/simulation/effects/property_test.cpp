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
      less.erase("exclusions");
      less.erase("vehicles");
    }
    Names without = on(effects::plan(scene_of(less)));
    // A joint keeps its bodies from touching, and with that what contacts alone call for.
    if (block == std::string("joints"))
      for (const char* const effect :
           {"contacts", "friction", "anisotropic_friction", "rolling_friction", "spinning_friction", "restitution",
            "ccd_on_demand", "split_impulse", "friction_caching", "forced_boxes"})
        without.erase(effect);
    // Multibodies are not where other things are, and what they have is neither swept nor tumbled.
    if (with.count("multibodies") + without.count("multibodies") > 0)
      for (const char* const effect : {"multibodies", "ccd", "ccd_on_demand", "gyroscopic"}) without.erase(effect);
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
    if (!both || gallery()[part].name == std::string("multibodies")) continue;
    document = std::move(*both);
    const Names after = on(effects::plan(scene_of(document)));
    RC_ASSERT(std::includes(after.begin(), after.end(), before.begin(), before.end()));
    const Names own = names_of(gallery()[part]);
    RC_ASSERT(std::includes(after.begin(), after.end(), own.begin(), own.end()));
    before = after;
  }
}

/// How much was compared.
struct Compared {
  std::size_t places = 0, effects_off = 0;
};

/// An effect that is off but should be on would change what happens. Runs a scene as it calls for, and with everything
/// on but `kept`.
void compare_with_everything_on(const nlohmann::json& document, const Names& kept, int steps, Compared& compared) {
  const scenes::Scene scene = scene_of(document);
  const effects::Plan called = effects::plan(scene);
  effects::Plan more = called;
  for (effects::Decision& decision : more) {
    if (decision.on || kept.contains(decision.effect->name)) continue;
    decision.on = true;
    ++compared.effects_off;
  }
  scenes::Simulation plain(scene, "boxstream", {}, called), full(scene, "boxstream", {}, more);
  const std::size_t bodies = plain.census().bodies;
  for (int step = 0; step < steps; ++step) {
    plain.advance();
    full.advance();
    for (std::size_t body = 0; body < bodies; ++body) {
      ASSERT_EQ(place_of(plain, body), place_of(full, body))
          << "body " << body << ", step " << step << ": " << document.dump();
      ++compared.places;
    }
  }
}

TEST(Plan, LeavesNothingOutThatWouldChangeATrajectory) {
  // What Bullet is told to do or not by the scene itself; what makes boxes larger, and with that the order of pairs.
  const Names settings{"split_impulse", "friction_caching", "ccd", "forced_boxes"};
  std::mt19937 random(1);
  Compared compared;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    std::vector<std::size_t> parts(1 + random() % 8);
    for (std::size_t& part : parts) part = random() % gallery().size();
    nlohmann::json document = all_of(parts);
    // Each body a little elsewhere, so that no two scenes are alike.
    for (nlohmann::json& body : document["bodies"])
      if (body.value("type", "dynamic") == "dynamic" && body.contains("position"))
        for (nlohmann::json& x : body["position"]) x = x.get<double>() + 1e-3 * (random() % 100);
    ASSERT_NO_FATAL_FAILURE(compare_with_everything_on(document, settings, 30, compared));
  }
  EXPECT_GT(compared.places, 10000u);
  EXPECT_GT(compared.effects_off, 5000u);
}

/// A scene of a few bodies of which everything is left to chance.
class RandomScene {
 public:
  using json = nlohmann::json;

  explicit RandomScene(unsigned seed) : random_(seed) {}

  json document() {
    json scene = json::parse(frame);
    for (const char* const name : {"m0", "m1", "m2", "m3"}) scene["materials"][name] = material();
    if (chance(0.5)) scene["world"]["gravity"] = {0, -9.81, 0};
    scene["world"]["on_leave"] = any<const char*>({"nothing", "freeze", "remove", "report"});
    if (chance(0.8)) add_floor(scene["bodies"]);
    // Often one alone: an effect that another body calls for is on for all.
    const int count = chance(0.4) ? 1 : 2 + static_cast<int>(random_() % 7);
    for (int i = 0; i < count; ++i) scene["bodies"].push_back(body("d" + std::to_string(i)));
    if (chance(0.3))
      scene["bodies"].push_back({{"name", "k"},
                                 {"shape", "box"},
                                 {"type", "kinematic"},
                                 {"material", "m0"},
                                 {"position", {3, 0.5, 0}},
                                 {"velocity", {-0.5, 0, 0}}});
    if (count > 1 && chance(0.4))
      scene["joints"] = {{{"type", any<const char*>({"ball", "fixed"})},
                          {"a", "d0"},
                          {"b", "d1"},
                          {"pivot", {0, 1, 0}},
                          {"collide", chance(0.5)}}};
    else if (chance(0.3))
      scene["joints"] = {{{"type", "hinge"},
                          {"a", "d0"},
                          {"pivot", {0, 1, 0}},
                          {"axis", {0, 0, 1}},
                          {"limits", {-30, 60}},
                          {"motor", {{"speed", any({0, 5})}, {"max_force", any({0, 100})}}}}};
    if (count > 2 && chance(0.2)) scene["exclusions"] = json::array({json::array({"d1", "d2"})});
    for (const json& field : json::parse(fields))
      if (chance(0.1)) scene["fields"].push_back(field);
    if (chance(0.3)) scene["sensors"] = {{{"name", "s"}, {"half_extents", {1, 1, 1}}, {"position", {0, 1, 0}}}};
    if (chance(0.15)) scene["characters"] = {{{"path", {{-3, 0.9, -3}, {3, 0.9, 3}}}, {"push", any({0, 50})}}};
    if (chance(0.1))
      scene["soft_bodies"] = {{{"type", "ball"}, {"mass", 1}, {"centre", {0, 3, 0}}, {"radius", 0.5}, {"pressure", 5}}};
    if (chance(0.3)) {
      json& vehicle = scene["vehicles"][0] = {{"chassis", "d0"}, {"engine", 100}, {"steer", 20}};
      for (const double x : {-0.3, 0.3})
        for (const double z : {-0.3, 0.3})
          vehicle["wheels"].push_back({{"at", {x, -0.1, z}}, {"driven", z < 0}, {"steered", z > 0}});
      // A chassis that meets nothing is moved by its wheels alone.
      for (json& b : scene["bodies"])
        if (b["name"] == "d0" && chance(0.5)) b["mask"] = 64;
    }
    return scene;
  }

 private:
  // Settings that the scene decides are on, so that they are left out where they have nothing to act on alone.
  static constexpr const char* frame = R"({
    "format": 1, "meta": {"name": "random", "about": "Left to chance."}, "time": {"dt": 0.016666666666666666, "steps": 200},
    "world": {"gravity": [0, 0, 0], "bounds": {"min": [-6, -6, -6], "max": [6, 6, 6]}},
    "solver": {"split_impulse": true, "cache_friction": true, "friction_directions": "two_fixed"},
    "broadphase": {"force_boxes": true},
    "shapes": [
      {"name": "ball", "type": "sphere", "radius": 0.3},
      {"name": "box", "type": "box", "half_extents": [0.3, 0.3, 0.3]},
      {"name": "plank", "type": "box", "half_extents": [0.6, 0.1, 0.3]},
      {"name": "capsule", "type": "capsule", "radius": 0.2, "height": 0.5},
      {"name": "cylinder", "type": "cylinder", "radius": 0.3, "height": 0.4},
      {"name": "hull", "type": "hull",
       "points": [[0.3, 0.3, 0.3], [-0.3, 0.3, -0.3], [0.3, -0.3, -0.3], [-0.3, -0.3, 0.3]]},
      {"name": "compound", "type": "compound",
       "children": [{"shape": "ball", "position": [0.4, 0, 0]}, {"shape": "box", "position": [-0.4, 0, 0]}]},
      {"name": "floor", "type": "box", "half_extents": [8, 0.5, 8]},
      {"name": "plane", "type": "plane", "normal": [0, 1, 0]},
      {"name": "mesh", "type": "mesh", "internal_edges": true, "heightfield": {"columns": 9, "rows": 9, "cell": 2,
       "hills": {"amplitude": 0.3, "wavelength": 5, "seed": 1}}},
      {"name": "field", "type": "heightfield", "columns": 9, "rows": 9, "cell": 2,
       "hills": {"amplitude": 0.3, "wavelength": 5, "seed": 1}}],
    "bodies": []})";
  static constexpr const char* fields = R"([
    {"type": "wind", "velocity": [3, 0, 0]}, {"type": "drag", "linear": 0.1, "angular": 0.1}, {"type": "drag"},
    {"type": "buoyancy", "level": 1}, {"type": "impulses", "share": 0.1, "speed": 3},
    {"type": "vortex", "centre": [0, 0, 0], "radius": 5, "height": 5, "speed": 1, "updraft": 1, "rate": 1}])";

  bool chance(double probability) { return number(0, 1) < probability; }
  double number(double low, double high) { return low + (high - low) * (random_() / 4294967296.0); }
  json vector(double low, double high) { return {number(low, high), number(low, high), number(low, high)}; }
  template <class T>
  T any(std::initializer_list<T> choices) {
    return choices.begin()[random_() % choices.size()];
  }
  const char* any_material() { return any<const char*>({"m0", "m1", "m2", "m3"}); }

  json material() {
    json m = {{"friction", any({0.0, 0.0, 0.5, 1.0})},
              {"rolling", any({0.0, 0.0, 0.1})},
              {"spinning", any({0.0, 0.0, 0.1})},
              {"restitution", any({0.0, 0.0, 0.5, 1.0})}};
    if (chance(0.2)) m["anisotropic"] = {1, 0.3, 1};
    return m;
  }

  void add_floor(json& bodies) {
    const std::string shape = any<const char*>({"floor", "plane", "mesh", "field"});
    const double height = shape == "floor" ? -0.5 : shape == "plane" ? 0 : -0.4;
    bodies.push_back({{"name", "floor"},
                      {"shape", shape},
                      {"type", "static"},
                      {"position", {0, height, 0}},
                      {"material", any_material()}});
    if (chance(0.3)) bodies.back()["surface_velocity"] = {1, 0, 0};
  }

  json body(const std::string& name) {
    // Sweeping makes boxes larger: all have it, or it would change the order of pairs.
    json b = {{"name", name},
              {"shape", any<const char*>({"ball", "box", "plank", "capsule", "cylinder", "hull", "compound"})},
              {"mass", any({0.1, 1.0, 50.0})},
              {"position", {number(-2, 2), number(0.4, 5), number(-2, 2)}},
              {"material", any_material()},
              {"ccd", {{"threshold", 0.1}, {"radius", 0.05}}}};
    if (chance(0.3)) b["velocity"] = vector(-5, 5);
    if (chance(0.2)) b["spin"] = vector(-5, 5);
    if (chance(0.2)) b["linear_damping"] = 0.1;
    if (chance(0.2)) b["mask"] = any({0, 1, 2, 3, 64});
    if (chance(0.1)) b["group"] = any({1, 2, 64});
    if (chance(0.1)) b["sleep"] = false;
    if (chance(0.1)) b["gyro"] = any<json>({true, false, "explicit"});
    return b;
  }

  std::mt19937 random_;
};

TEST(Plan, LeavesNothingOutOfScenesLeftToChance) {
  Compared compared;
  for (unsigned seed = 0; seed < 600; ++seed) {
    SCOPED_TRACE(seed);
    ASSERT_NO_FATAL_FAILURE(compare_with_everything_on(RandomScene(seed).document(), {"ccd"}, 100, compared));
  }
  EXPECT_GT(compared.places, 150000u);
  EXPECT_GT(compared.effects_off, 12000u);
}

}  // namespace
}  // namespace boxstream::effects_test
