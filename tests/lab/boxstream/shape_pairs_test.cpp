// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "formats/scene_json/load_scene.hpp"
#include "process.hpp"

namespace boxstream::tool_test {
namespace {

const std::string four_shapes = R"(
{"format": 1,
 "shapes": [{"name": "ball", "type": "sphere", "radius": 1},
            {"name": "slab", "type": "box", "half_extents": [4, 1, 4]},
            {"name": "pole", "type": "capsule", "radius": 0.5, "height": 4},
            {"name": "wedge", "type": "hull", "points": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]}],
 "bodies": [{"shape": "slab"},
            {"shape": "ball", "name": "ball", "position": [0, 1.5, 0]},
            {"shape": "pole", "name": "pole", "position": [3, 3.25, 0]},
            {"shape": "ball", "name": "corner", "position": [4.9, 0, 4.9]},
            {"shape": "wedge", "position": [100, 0, 0]}]})";

std::string with(const std::string& from, const std::string& to) {
  std::string text = four_shapes;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(ShapePairs, Count) {
  const Outcome count = run_tool({"pairs", "-"}, {four_shapes, false});
  EXPECT_EQ(count.exit_code, 0) << count.err;
  EXPECT_EQ(count.out, "shapes 5, pairs of boxes 3, of shapes 2\n");
}

TEST(ShapePairs, ListHasDepthsAndDistances) {
  const Outcome list = run_tool({"pairs", "--list", "-"}, {four_shapes, false});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  std::vector<std::string> lines;
  std::istringstream text(list.out);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0], "0 ball touch depth 0.5 direction 0 1 0 by cores");
  // From the edge of the slab, (0.9, 0.9) away; the ball's radius is 1.
  EXPECT_EQ(lines[1], "0 corner apart distance 0.272792206");
  EXPECT_EQ(lines[2], "0 pole touch depth 0.25 direction 0 1 0 by cores") << "capsules of scenes stand upright";
}

TEST(ShapePairs, ShippedExample) {
  const Outcome table = run_tool({"pairs", scenes::shipped("shapes/table.json")});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_EQ(table.out, "shapes 9, pairs of boxes 9, of shapes 8\n");
}

/// Experiments: other solvers, and too few iterations.
TEST(ShapePairs, SolversAndIterations) {
  const auto list = [](const std::vector<std::string>& more) {
    std::vector<std::string> words{"pairs", "--list", scenes::shipped("shapes/table.json")};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = run_tool(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.out;
  };
  EXPECT_NE(list({}).find("roll prism touch depth 0.0514009444 direction 0.890584 -0.454818 0 by epa"),
            std::string::npos);
  EXPECT_NE(list({"--solver", "mpr"}).find(" by mpr"), std::string::npos);
  EXPECT_EQ(list({"--solver", "mpr"}).find(" by epa"), std::string::npos);
  EXPECT_NE(list({"--iterations", "2"}).find(" (iteration limit)"), std::string::npos);
  EXPECT_EQ(run_tool({"pairs", "-", "--solver", "sat"}).exit_code, 2);
}

TEST(ShapePairs, NoBodiesAreNoPairs) {
  const Outcome none = run_tool({"pairs", "-"}, {R"({"format": 1, "shapes": [], "bodies": []})", false});
  EXPECT_EQ(none.out, "shapes 0, pairs of boxes 0, of shapes 0\n");
}

TEST(ShapePairs, MistakesAreNamedByPointer) {
  const std::pair<std::string, std::string> cases[] = {
      {with("\"radius\": 1", "\"radius\": 0"), "/shapes/0/radius: must be greater than 0, got 0"},
      {with("\"shape\": \"slab\"", "\"shape\": \"slob\""), "/bodies/0/shape: no shape called \"slob\""},
      {with("\"name\": \"pole\", \"position\"", "\"name\": \"ball\", \"position\""), "/bodies/2/name: a second body"},
      {with("[3, 3.25, 0]", "[3, 3.25]"), "/bodies/2/position: must have 3 elements, got 2"},
      {with("\"type\": \"sphere\", \"radius\": 1", "\"type\": \"plane\", \"normal\": [0, 1, 0]"),
       "/bodies/1/shape: only convex shapes can be tested"},
      {with("{\"shape\": \"slab\"}", "{\"shape\": \"slab\", \"mass\": 1}"), "/bodies/0/mass: unknown key"},
      {"{\"format\": 1", ""}};
  for (const auto& [text, reason] : cases) {
    const Outcome outcome = run_tool({"pairs", "-"}, {text, false});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("boxstream: standard input: " + reason)) << outcome.err << reason;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1);
  }
  EXPECT_EQ(run_tool({"pairs", "-", "--tolerance", "0"}, {four_shapes, false}).exit_code, 2);
}

TEST(ShapePairs, MayBeginWithAByteOrderMark) {
  const Outcome marked = run_tool({"pairs", "-"}, {std::string("\xEF\xBB\xBF") + four_shapes, false});
  EXPECT_EQ(marked.exit_code, 0) << marked.err;
  EXPECT_EQ(marked.out, run_tool({"pairs", "-"}, {four_shapes, false}).out);
  const Outcome broken = run_tool({"pairs", "-"}, {std::string("\xEF\xBB{}"), false});
  EXPECT_EQ(broken.exit_code, 2);
}

}  // namespace
}  // namespace boxstream::tool_test
