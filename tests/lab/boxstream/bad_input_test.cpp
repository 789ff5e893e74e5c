// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "process.hpp"
#include "refusal.hpp"
#include "scratch_directory.hpp"

namespace boxstream::tool_test {
namespace {

const std::string small_scene = R"({
  "format": 1,
  "meta": {"name": "small", "about": "A ball over a floor."},
  "time": {"dt": 0.01, "steps": 3},
  "world": {"bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]}},
  "shapes": [{"name": "slab", "type": "box", "half_extents": [4, 1, 4]}, {"name": "ball", "type": "sphere", "radius": 1}],
  "bodies": [
    {"shape": "slab", "type": "static", "position": [0, -1, 0]},
    {"shape": "ball", "mass": 1, "position": [0, 0.9, 0]}
  ]
})";

std::string with(const std::string& from, const std::string& to) {
  std::string text = small_scene;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(BadInput, SmallSceneItselfRuns) {
  const ScratchDirectory directory;
  const Outcome outcome = run_tool({"simulate", directory.write("small.json", small_scene)});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(lasting_words(outcome), "");
}

struct BadScene {
  const char* name;
  std::string text;
  std::vector<std::string> parts;

  friend std::ostream& operator<<(std::ostream& out, const BadScene& scene) { return out << scene.name; }
};

class BadScenes : public testing::TestWithParam<BadScene> {};

TEST_P(BadScenes, OneLineWithFilePointerAndReason) {
  const ScratchDirectory directory;
  const std::string scene = directory.write("bad.json", GetParam().text);
  std::vector<std::string> parts{scene + ": "};
  parts.insert(parts.end(), GetParam().parts.begin(), GetParam().parts.end());
  expect_refusal(
      run_tool({"simulate", scene, "--json", directory.file("out.json"), "--picture", directory.file("out.png")}),
      parts);
  EXPECT_EQ(directory.count(), 1U) << "something was written";
}

INSTANTIATE_TEST_SUITE_P(
    Files, BadScenes,
    testing::Values(BadScene{"unknown_key", with("\"steps\"", "\"step\""), {": /time/step: ", "unknown key"}},
                    BadScene{"wrong_type", with("[0, 0.9, 0]", "\"up\""), {": /bodies/1/position: ", "string"}},
                    BadScene{"wrong_type_of_steps", with("\"steps\": 3", "\"steps\": 2.5"), {": /time/steps: "}},
                    BadScene{"negative_mass", with("\"mass\": 1", "\"mass\": -1"), {": /bodies/1/mass: ", "-1"}},
                    BadScene{"nan", with("\"mass\": 1", "\"mass\": NaN"), {": /bodies/1/mass: "}},
                    BadScene{"beyond_double", with("\"mass\": 1", "\"mass\": 1e999"), {": /bodies/1/mass: "}},
                    BadScene{"unknown_shape",
                             with("{\"shape\": \"ball\"", "{\"shape\": \"bell\""),
                             {": /bodies/1/shape: ", "bell"}},
                    BadScene{"missing_mesh_file",
                             with("\"type\": \"sphere\", \"radius\": 1", "\"type\": \"mesh\", \"file\": \"none.obj\""),
                             {": /shapes/1/file: ", "none.obj"}},
                    BadScene{"empty_file", "", {"parse error"}},
                    BadScene{"cut_off", small_scene.substr(0, small_scene.size() / 2), {"parse error"}},
                    BadScene{"no_object", "[1, 2]", {": /: "}}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(BadInput, MissingScene) {
  const ScratchDirectory directory;
  expect_refusal(run_tool({"simulate", directory.file("none.json")}), {"none.json: ", "No such file"});
  expect_refusal(run_tool({"simulate", "nonesuch"}), {"unknown scene 'nonesuch' (", "boxstream list"});
  EXPECT_EQ(directory.count(), 0U);
}

TEST(BadInput, UnknownBroadphaseListsTheNames) {
  const std::vector<std::string> names{"'octree'; there are boxstream, hybrid, dbvt, dbvt-deferred, sap, simple"};
  expect_refusal(run_tool({"simulate", "pile", "--broadphase", "octree"}), names);
  expect_refusal(run_tool({"simulate", "pile", "--compare", "octree"}), names);
}

TEST(BadInput, Options) {
  expect_refusal(run_tool({}), {"subcommand"});
  expect_refusal(run_tool({"simulate"}), {"SCENE"});
  expect_refusal(run_tool({"simulate", "pile", "--nonesuch"}), {"--nonesuch"});
  for (const char* const steps : {"0", "-1", "1.5", "x", "99999999999"})
    expect_refusal(run_tool({"simulate", "pile", "--steps", steps}), {"--steps"});
}

TEST(BadInput, OutputsAreCheckedBeforeTheFirstStep) {
  const ScratchDirectory directory;
  const std::string scene = directory.write("small.json", small_scene);
  const std::string nowhere = directory.file("no/such/out.json");
  expect_refusal(run_tool({"simulate", scene, "--json", nowhere}), {nowhere, "No such file"});
  expect_refusal(run_tool({"simulate", scene, "--json", directory.file("")}), {"directory"});
  expect_refusal(run_tool({"simulate", scene, "--picture", directory.file("out.jpg")}), {"out.jpg", ".png", ".svg"});
  const std::string same = directory.file("out.png");
  expect_refusal(run_tool({"simulate", scene, "--picture", same, "--json", same}), {"out.png"});
  EXPECT_EQ(directory.count(), 1U);
}

TEST(BadInput, AnEarlierResultSurvives) {
  const ScratchDirectory directory;
  const std::string out = directory.write("out.json", "earlier");
  expect_refusal(run_tool({"simulate", "pile", "--json", out, "--broadphase", "x"}), {});
  expect_refusal(run_tool({"simulate", directory.write("bad.json", "{"), "--json", out}), {});
  EXPECT_EQ(directory.read("out.json"), "earlier");
}

}  // namespace
}  // namespace boxstream::tool_test
