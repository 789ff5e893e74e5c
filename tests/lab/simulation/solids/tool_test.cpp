// SPDX-License-Identifier: MIT
// The same through the command: heights in what `simulate` writes, and the line that says what will be wrong.
#include <gtest/gtest.h>

#include <string>

#include <nlohmann/json.hpp>

#include "process.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

using nlohmann::json;

/// A box, a cone and a hull of that size, side by side on a table.
std::string scene_of(double size, double low, double high) {
  const double r = size / 2;
  const json shapes{{{"name", "table"}, {"type", "box"}, {"half_extents", {5 * size, size, 5 * size}}},
                    {{"name", "box"}, {"type", "box"}, {"half_extents", {r, r, r}}},
                    {{"name", "cone"}, {"type", "cone"}, {"radius", r}, {"height", size}},
                    {{"name", "hull"},
                     {"type", "hull"},
                     {"points", {{-r, -r, -r}, {r, -r, -r}, {0, -r, r}, {-r, r, -r}, {r, r, -r}, {0, r, r}}}}};
  json bodies{{{"shape", "table"}, {"type", "static"}, {"position", {0, -size, 0}}}};
  double x = -2 * size;
  for (const char* const shape : {"box", "cone", "hull"}) {
    bodies.push_back({{"name", shape}, {"shape", shape}, {"density", 500}, {"position", {x, r, 0}}});
    x += 2 * size;
  }
  const json checks{{{"metric", "lowest"}, {"op", ">="}, {"value", low}},
                    {{"metric", "highest"}, {"op", "<="}, {"value", high}}};
  const double wide = 20 * size;
  return json{{"format", 1},
              {"meta", {{"name", "three"}, {"about", "three"}, {"source", "own"}}},
              {"time", {{"dt", 1.0 / 60}, {"steps", 180}}},
              {"world", {{"bounds", {{"min", {-wide, -wide, -wide}}, {"max", {wide, wide, wide}}}}}},
              {"shapes", shapes},
              {"bodies", bodies},
              {"checks", checks}}
      .dump();
}

TEST(Tool, HeightsOfSmallAndLargeBodiesAreThoseOfTheirShapes) {
  const ScratchDirectory scratch;
  for (const double size : {0.004, 0.03, 2.0, 60.0}) {
    const std::string file = scratch.write("three.json", scene_of(size, 0.499 * size, 0.501 * size));
    const Outcome run = run_tool({"simulate", file, "--json", "-"});
    EXPECT_EQ(run.exit_code, 0) << size << ": " << run.err;
    const json world = json::parse(run.out)["worlds"][0];
    for (const json& check : world["checks"]) EXPECT_TRUE(check["passed"].get<bool>()) << size << check;
    bool units = false;
    for (const json& effect : world["effects"]) units = units || effect == "unit_contacts";
    EXPECT_EQ(units, size < 1) << size;
  }
}

TEST(Tool, WhatWillBeWrongIsSaidBeforeTheRun) {
  const ScratchDirectory scratch;
  const std::string crumbs = scratch.write("crumbs.json", scene_of(0.002, 0, 1)),
                    cubes = scratch.write("cubes.json", scene_of(1, 0, 1));
  EXPECT_NE(run_tool({"simulate", crumbs}).err.find("in a step from rest"), std::string::npos);
  EXPECT_EQ(lasting_words(run_tool({"simulate", cubes})), "");
  EXPECT_NE(run_tool({"explain", crumbs}).out.find("in a step from rest"), std::string::npos);
  const json explained = json::parse(run_tool({"explain", crumbs, "--json", "-"}).out);
  EXPECT_EQ(explained["warnings"].size(), 1u);
  EXPECT_EQ(json::parse(run_tool({"explain", cubes, "--json", "-"}).out)["warnings"].size(), 0u);
}

}  // namespace
}  // namespace boxstream::tool_test
