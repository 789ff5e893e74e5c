// SPDX-License-Identifier: MIT
// That every shape, from a millimetre to a hundred metres, rests where it ends and touches nothing beside it.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include "formats/scene_json/load_scene.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/plan.hpp"
#include "simulation/effects/unfit.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::scenes {
namespace {

/// A shape that is as large as `size` along its largest axis, how high its origin is when it lies, and how it is
/// turned.
struct Kind {
  std::string name, shapes;  // the last one is the body's
  double height;             // of the origin above the ground, as a share of the size
  std::string rotation = "";
};

std::string points(const std::vector<Vec3>& corners, double size) {
  std::string list;
  for (const auto& [x, y, z] : corners)
    list += fmt::format("{}[{}, {}, {}]", list.empty() ? "" : ", ", x * size, y * size, z * size);
  return list;
}

std::vector<Kind> kinds(double s) {
  std::vector<Vec3> prism;
  for (const double y : {-0.5, 0.5})
    for (int k = 0; k < 7; ++k) prism.push_back({0.5 * std::cos(k * 0.8976), y, 0.5 * std::sin(k * 0.8976)});
  const std::vector<Vec3> cube{{-.5, -.5, -.5}, {.5, -.5, -.5}, {-.5, .5, -.5}, {.5, .5, -.5},
                               {-.5, -.5, .5},  {.5, -.5, .5},  {-.5, .5, .5},  {.5, .5, .5}};
  const std::vector<Vec3> pyramid{{-.5, -.3, -.5}, {.5, -.3, -.5}, {-.5, -.3, .5}, {.5, -.3, .5}, {0, .6, 0}};
  const std::string lying = R"(, "rotation": {"axis": [0, 0, 1], "degrees": 90})";
  const auto shape = [](const std::string& type, const std::string& rest) {
    return fmt::format(R"({{"name": "it", "type": "{}", {}}})", type, rest);
  };
  const auto half = [&](double x, double y, double z) {
    return fmt::format(R"("half_extents": [{}, {}, {}])", x * s, y * s, z * s);
  };
  const auto round = [&](double r, double h) { return fmt::format(R"("radius": {}, "height": {})", r * s, h * s); };
  return {{"box", shape("box", half(.5, .5, .5)), .5},
          {"slab", shape("box", half(.5, .1, .4)), .1},
          {"ball", shape("sphere", fmt::format(R"("radius": {})", s / 2)), .5},
          {"cylinder", shape("cylinder", round(.5, 1)), .5},
          {"cylinder that lies", shape("cylinder", round(.4, 1)), .4, lying},
          {"capsule that lies", shape("capsule", round(.3, .4)), .3, lying},
          {"cone", shape("cone", round(.5, 1)), .5},
          {"cube as a hull", shape("hull", fmt::format(R"("points": [{}])", points(cube, s))), .5},
          {"prism", shape("hull", fmt::format(R"("points": [{}])", points(prism, s))), .5},
          {"pyramid", shape("hull", fmt::format(R"("points": [{}])", points(pyramid, s))), .3},
          {"rounded hull", shape("hull", fmt::format(R"("points": [{}], "margin": {})", points(cube, s), s / 20)), .5},
          {"compound",
           fmt::format(R"({{"name": "part", "type": "box", {}}},
             {{"name": "it", "type": "compound", "children": [{{"shape": "part", "position": [{}, 0, 0]}},
              {{"shape": "part", "position": [{}, 0, 0]}}]}})",
                       half(.25, .5, .5), -s / 4, s / 4),
           .5},
          {"disc", shape("cylinder", round(.5, .15)), .075},
          {"stool",
           fmt::format(R"({{"name": "seat", "type": "box", {}}}, {{"name": "leg", "type": "box", {}}},
             {{"name": "it", "type": "compound", "children": [{{"shape": "seat", "position": [0, {}, 0]}},
              {{"shape": "leg", "position": [{}, 0, 0]}}, {{"shape": "leg", "position": [{}, 0, {}]}},
              {{"shape": "leg", "position": [{}, 0, {}]}}]}})",
                       half(.5, .06, .45), half(.04, .25, .04), .31 * s, .4 * s, -.3 * s, .35 * s, -.3 * s, -.35 * s),
           .25}};
}

constexpr double sizes[] = {0.001, 0.01, 0.1, 0.4, 1, 10, 100};

std::string ground(const std::string& kind, double s) {
  if (kind == "plane") return R"({"name": "g", "type": "plane", "normal": [0, 1, 0]}, )";
  return fmt::format(R"({{"name": "g", "type": "box", "half_extents": [{}, {}, {}]}}, )", 2 * s, s / 2, 2 * s);
}

Scene world(const std::string& shapes, const std::string& bodies, double s, int steps, const std::string& more = "") {
  const double wide = 100 * s;
  return parse_scene(fmt::format(R"({{"format": 1, "meta": {{"name": "x", "about": "x", "source": "x"}},
    "time": {{"dt": 0.016666666666666666, "steps": {}}},
    "world": {{"bounds": {{"min": [{}, {}, {}], "max": [{}, {}, {}]}}{}}}, "shapes": [{}], "bodies": [{}]}})",
                                 steps, -wide, -wide, -wide, wide, wide, wide, more, shapes, bodies),
                     "sizes.json");
}

class OfSize : public testing::TestWithParam<double> {};

TEST_P(OfSize, EveryShapeRestsWhereItEnds) {
  const double s = GetParam();
  for (const Kind& kind : kinds(s)) {
    // It falls by more than itself in a step, which ten iterations do not spread over twelve contacts.
    if (kind.name == "stool" && s < 0.005) continue;
    for (const std::string on : {"plane", "box"}) {
      const Scene scene = world(ground(on, s) + kind.shapes,
                                fmt::format(R"({{"shape": "g", "type": "static", "position": [0, {}, 0]}},
                  {{"shape": "it", "density": 800, "position": [0, {}, 0]{}}})",
                                            on == "plane" ? 0 : -s / 2, kind.height * s, kind.rotation),
                                s, 240);
      Simulation simulation(scene, "boxstream");
      for (int i = 0; i < 240; ++i) simulation.advance();
      const btVector3 at = simulation.pose(1).getOrigin();
      EXPECT_NEAR(at.y() / s, kind.height, 1e-3) << kind.name << " on a " << on;
      EXPECT_NEAR(at.x() / s, 0, 5e-2) << kind.name << " on a " << on;
      EXPECT_NEAR(at.z() / s, 0, 5e-2) << kind.name << " on a " << on;
    }
  }
}

TEST_P(OfSize, ShapesAHundredthOfTheirSizeApartDoNotTouch) {
  const double s = GetParam();
  for (const Kind& kind : kinds(s)) {
    const Scene scene = world(kind.shapes,
                              fmt::format(R"({{"shape": "it", "density": 800}},
                                {{"shape": "it", "density": 800, "position": [{}, 0, 0]}},
                                {{"shape": "it", "density": 800, "position": [0, 0, {}]}})",
                                          1.01 * s, 1.01 * s),
                              s, 20, R"(, "gravity": [0, 0, 0])");
    Simulation simulation(scene, "boxstream");
    for (int i = 0; i < 20; ++i) {
      simulation.advance();
      ASSERT_EQ(simulation.metric(Check::Metric::max_penetration), 0) << kind.name;
    }
    EXPECT_EQ(simulation.metric(Check::Metric::max_speed), 0) << kind.name;
  }
}

// The one that is above lies on the one below, and not on a margin between them. What is a millimetre large falls by
// more than itself in a step: ten iterations do not hold a stack of that.
TEST_P(OfSize, HullsAndConesAreStackedAsHighAsTheyAre) {
  const double s = GetParam(), allowed = s < 0.05 ? 1e-2 : 2e-3;
  if (s < 0.005) GTEST_SKIP();
  for (const Kind& kind : kinds(s)) {
    if (kind.name != "cube as a hull" && kind.name != "prism" && kind.name != "box") continue;
    const Scene scene = world(ground("box", s) + kind.shapes,
                              fmt::format(R"({{"shape": "g", "type": "static", "position": [0, {}, 0]}},
                                {{"shape": "it", "density": 800, "position": [0, {}, 0], "sleep": false}},
                                {{"shape": "it", "density": 800, "position": [0, {}, 0], "sleep": false}})",
                                          -s / 2, 0.5 * s, 1.5 * s),
                              s, 240);
    Simulation simulation(scene, "boxstream");
    for (int i = 0; i < 240; ++i) simulation.advance();
    EXPECT_NEAR(double{simulation.pose(1).getOrigin().y()} / s, 0.5, allowed) << kind.name;
    EXPECT_NEAR(double{simulation.pose(2).getOrigin().y()} / s, 1.5, allowed) << kind.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes, OfSize, testing::ValuesIn(sizes));

bool calls_for_unit_contacts(const std::string& shape) {
  const Scene scene =
      world(ground("plane", 1) + shape,
            R"({"shape": "g", "type": "static"}, {"shape": "it", "density": 800, "position": [0, 1, 0]})", 1, 10);
  return effects::is_on(effects::plan(scene), effects::unit_contacts);
}

TEST(UnitContacts, AreCalledForBySmallShapesAlone) {
  for (const Kind& kind : kinds(3)) EXPECT_FALSE(calls_for_unit_contacts(kind.shapes)) << kind.name;
  for (const Kind& kind : kinds(0.01)) EXPECT_TRUE(calls_for_unit_contacts(kind.shapes)) << kind.name;
}

// At 0.2 m/s a marble rolls by twenty times its size in a second, and is not at rest.
TEST(Sleep, ASmallBodyThatRollsIsAwake) {
  const Scene scene = world(ground("plane", 1) + R"({"name": "it", "type": "sphere", "radius": 0.005})",
                            R"({"shape": "g", "type": "static"},
                               {"shape": "it", "density": 2500, "position": [0, 0.005, 0], "velocity": [0.2, 0, 0],
                                "spin": [0, 0, -40]})",
                            1, 600);
  Simulation simulation(scene, "boxstream");
  for (int i = 0; i < 600; ++i) simulation.advance();
  EXPECT_NEAR(double{simulation.pose(1).getOrigin().x()}, 2, 0.05);
}

TEST(Unfit, ABodyThatFallsFartherThanItIsLargeIsNamed) {
  const auto lines = [](double s, const std::string& place) {
    return effects::unfit(world(ground("plane", 1) + kinds(s)[0].shapes,
                                R"({"shape": "g", "type": "static"},
                                   {"name": "crumb", "shape": "it", "density": 800, "position": )" +
                                    place + "}",
                                1, 10));
  };
  EXPECT_TRUE(lines(1, "[0, 1, 0]").empty());
  ASSERT_EQ(lines(0.002, "[0, 1, 0]").size(), 1u);
  EXPECT_NE(lines(0.002, "[0, 1, 0]")[0].find("crumb"), std::string::npos);
  EXPECT_NE(lines(0.002, "[0, 1, 0]")[0].find("substeps"), std::string::npos);
}

TEST(Unfit, ABodyThatFallsFartherThanItIsThickIsNamed) {
  const auto lines = [](double thickness, double dt) {
    Scene scene = world(ground("plane", 1) + R"({"name": "it", "type": "box", "half_extents": [0.3, )" +
                            std::to_string(thickness / 2) + R"(, 0.2]})",
                        R"({"shape": "g", "type": "static"},
                           {"name": "tile", "shape": "it", "mass": 1, "position": [0, 1, 0]})",
                        1, 10);
    scene.time.dt = dt;
    return effects::unfit(scene);
  };
  EXPECT_TRUE(lines(0.1, 1.0 / 60).empty());
  EXPECT_TRUE(lines(0.1, 1.0 / 30).empty());
  ASSERT_EQ(lines(0.1, 0.1).size(), 1u);
  EXPECT_NE(lines(0.1, 0.1)[0].find("(\"tile\") is 0.1 m thick and falls 0.098 m"), std::string::npos)
      << lines(0.1, 0.1)[0];
  EXPECT_NE(lines(0.1, 0.1)[0].find("take 3 substeps"), std::string::npos) << lines(0.1, 0.1)[0];
}

}  // namespace
}  // namespace boxstream::scenes
