// SPDX-License-Identifier: MIT
// Kinds are listed once, in the variants of the scene model. The compiler checks their readers and what engines
// make of them; these tests see to the schema, and to the scenes that the other tests take all kinds from.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "formats/scene_model/scene.hpp"
#include "source_path.hpp"

namespace boxstream::scenes {
namespace {

using Words = std::set<std::string>;

nlohmann::json read(const std::filesystem::path& path) {
  std::ifstream in(path);
  return nlohmann::json::parse(in);
}

template <class... T>
Words kinds_of(const std::variant<T...>*) {
  return {T::kind...};
}

/// Calls check(block of a scene, its definition in the schema, its kinds) for each block of variants.
template <class Check>
void for_each_block(const Check& check) {
  const auto of = []<class Variant>(Variant value) { return kinds_of(&value); };
  check("shapes", "shape", of(ShapeValue{}));
  check("joints", "joint", of(JointValue{}));
  check("generators", "generator", of(Generator{}));
  check("fields", "field", of(Field{}));
  check("queries", "query", of(Query{}));
  check("soft_bodies", "soft_body", of(decltype(SoftBody::value){}));
}

TEST(Kinds, AreInTheSchema) {
  const nlohmann::json definitions = read(tests::source_path("demos/formats/scene_json/scene.schema.json"))["$defs"];
  for_each_block([&](const char*, const char* definition, const Words& kinds) {
    const nlohmann::json& block = definitions[definition];
    EXPECT_EQ(block["properties"]["type"]["enum"].get<Words>(), kinds) << definition;
    Words described;
    for (const nlohmann::json& rule : block["allOf"])
      if (rule.contains("/if/properties/type/const"_json_pointer))
        described.insert(rule["if"]["properties"]["type"]["const"].get<std::string>());
    EXPECT_EQ(described, kinds) << definition;
  });
}

TEST(Kinds, AreInTheScenesOfEverything) {
  for_each_block([](const char* block, const char*, const Words& kinds) {
    Words found;
    for (const auto& entry : std::filesystem::directory_iterator(tests::source_path("tests/lab/scenes"))) {
      if (!entry.path().filename().string().starts_with("every_") || entry.path().extension() != ".json") continue;
      const nlohmann::json scene = read(entry.path());
      if (scene.contains(block))
        for (const nlohmann::json& item : scene[block]) found.insert(item["type"].get<std::string>());
    }
    EXPECT_EQ(found, kinds) << block;
  });
}

}  // namespace
}  // namespace boxstream::scenes
