// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "formats/scene_model/scene_error.hpp"
#include "simulation/query/objects.hpp"
#include "simulation/query/scene.hpp"

namespace boxstream::query_test {
namespace {

const std::string small_scene = R"({
  "format": 1,
  "meta": {"name": "small", "about": "a gripper over some balls"},
  "steps": 5,
  "shapes": [{"name": "ball", "type": "sphere", "radius": 0.1}],
  "groups": [
    {"name": "balls", "margin": 0.2, "objects": [
      {"type": "scatter", "count": 10, "origin": [0, 0, 0], "size": [1, 1, 1], "mix": [{"shape": "ball"}]}]},
    {"name": "hand", "objects": [{"type": "gripper", "path": [[0, 1, 0], [0, 0, 0]]}]}
  ],
  "queries": [
    {"kind": "distance", "a": "hand", "b": "balls"},
    {"kind": "within", "a": "balls", "limit": 0.2}
  ]
})";

std::string with(const std::string& from, const std::string& to) {
  std::string text = small_scene;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(Load, SmallSceneItself) {
  const query::QueryScene scene = query::parse_query_scene(small_scene, "small.json");
  EXPECT_EQ(scene.steps, 5);
  ASSERT_EQ(scene.groups.size(), 2U);
  EXPECT_EQ(scene.groups[0].margin, 0.2);
  ASSERT_EQ(scene.queries.size(), 2U);
  EXPECT_EQ(scene.queries[0].kind, query::Kind::distance);
  EXPECT_EQ(scene.queries[0].a, 1U);
  EXPECT_EQ(scene.queries[0].b, 0U);
  EXPECT_EQ(scene.queries[1].name, "balls itself, within");
  EXPECT_EQ(std::get<query::Gripper>(scene.groups[1].actors[0]).fingers, 3);
}

TEST(Load, MistakesAreNamedByFileAndPointer) {
  const std::pair<std::string, std::string> cases[] = {
      {with("\"steps\": 5", "\"steps\": 0"), "q.json: /steps: must be at least 1, got 0"},
      {with("\"steps\": 5", "\"step\": 5"), "q.json: /step: unknown key"},
      {with("\"format\": 1", "\"format\": 2"), "q.json: /format: "},
      {with("\"type\": \"sphere\"", "\"type\": \"hull\""), "q.json: /shapes/0/type: unknown value \"hull\""},
      {with("\"radius\": 0.1", "\"radius\": -1"), "q.json: /shapes/0/radius: must be greater than 0"},
      {with("{\"shape\": \"ball\"}", "{\"shape\": \"bell\"}"),
       "q.json: /groups/0/objects/0/mix/0/shape: no shape called \"bell\""},
      {with("\"count\": 10", "\"count\": -1"), "q.json: /groups/0/objects/0/count: "},
      {with("[[0, 1, 0], [0, 0, 0]]", "[]"), "q.json: /groups/1/objects/0/path: must have at least 1 elements"},
      {with("\"name\": \"hand\"", "\"name\": \"balls\""), "q.json: /groups/1/name: a second group"},
      {with("\"a\": \"hand\"", "\"a\": \"foot\""), "q.json: /queries/0/a: no group called \"foot\""},
      {with("\"b\": \"balls\"", "\"b\": \"hand\""), "q.json: /queries/0/b: the same group"},
      {with(", \"b\": \"balls\"", ""), "q.json: /queries/0/kind: a distance is between two groups"},
      {with("\"kind\": \"within\", \"a\": \"balls\"", "\"kind\": \"within\", \"a\": \"balls\", \"each_object\": true"),
       "q.json: /queries/1/each_object: "},
      {with("\"limit\": 0.2", "\"limit\": 0.3"), "q.json: /queries/1/limit: the boxes do not reach that far"},
      {with(", \"limit\": 0.2", ""), "q.json: /queries/1: key \"limit\" is missing"},
      {"[]", "q.json: /: expected an object"},
      {"{", "q.json: "}};
  for (const auto& [text, expected] : cases) {
    try {
      query::parse_query_scene(text, "q.json");
      ADD_FAILURE() << "no error: " << expected;
    } catch (const scenes::SceneError& error) {
      const std::string what = error.what();
      EXPECT_TRUE(what.starts_with(expected)) << what << "\nexpected " << expected;
      EXPECT_EQ(what.find('\n'), std::string::npos);
    }
  }
}

TEST(Scaled, CountsAndRoom) {
  const query::QueryScene scene = query::parse_query_scene(small_scene, "small.json");
  const auto large = std::get<query::Scatter>(query::scaled(scene, 8).groups[0].actors[0]);
  EXPECT_EQ(large.count, 80);
  EXPECT_NEAR(large.size[1], 2, 1e-12);
  EXPECT_EQ(std::get<query::Scatter>(query::scaled(scene, 0.001).groups[0].actors[0]).count, 1);
}

/// Every edge belongs to two triangles, once in each direction: a closed surface, all of it facing one way; and
/// outwards, as the volume is positive.
void expect_closed(const scenes::MeshShape& mesh, double volume, double allowed) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(t[i], t[(i + 1) % 3]);
    const auto &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  std::sort(edges.begin(), edges.end());
  EXPECT_EQ(std::adjacent_find(edges.begin(), edges.end()), edges.end());
  for (const auto& [from, to] : edges)
    EXPECT_TRUE(std::binary_search(edges.begin(), edges.end(), std::pair(to, from))) << from << ' ' << to;
  EXPECT_NEAR(sum / 6, volume, allowed);
}

TEST(Meshes, AreClosedAndFaceOutwards) {
  const double torus = 2 * std::numbers::pi * std::numbers::pi * 3 * 1;  // radius 3, tube 1
  expect_closed(query::ring_mesh(3, 1, 64, 64), torus, 0.01 * torus);
  expect_closed(query::bracket_mesh(3, 2, 1), 2 * (9 - 4), 1e-12);
}

}  // namespace
}  // namespace boxstream::query_test
