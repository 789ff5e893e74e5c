// SPDX-License-Identifier: MIT
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_parts.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_json/old_words.hpp"

namespace boxstream::scenes {
namespace {

void load_meta(const Node& node, Scene& scene) {
  Fields fields(node);
  scene.meta.name = fields.require("name").text();
  scene.meta.about = fields.require("about").text();
  scene.meta.source = fields.text("source", "");
  if (const auto tags = fields.find("tags"))
    for (const Node& tag : tags->list(0, 32)) scene.meta.tags.push_back(tag.text());
  fields.finish();
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name) {
  nlohmann::json document = parse_json(text, name);
  std::vector<std::string> old_words = renew_words(document);
  const Node root(document, "", name);
  Fields fields(root);
  fields.require("format").integer(1, 1);

  Scene scene;
  scene.file = name;
  scene.old_words = std::move(old_words);
  Names names;
  load_meta(fields.require("meta"), scene);
  load_time(fields.require("time"), scene);
  load_world(fields.require("world"), scene);
  if (const auto node = fields.find("solver")) load_solver(*node, scene);
  if (const auto node = fields.find("broadphase")) load_broadphase(*node, scene);
  if (const auto node = fields.find("materials")) load_materials(*node, names);
  if (const auto node = fields.find("shapes")) load_shapes(*node, scene, names);
  if (const auto node = fields.find("bodies")) load_bodies(*node, scene, names);
  if (const auto node = fields.find("generators")) load_generators(*node, scene, names);
  if (const auto node = fields.find("joints")) load_joints(*node, scene, names);
  if (const auto node = fields.find("exclusions")) load_exclusions(*node, scene, names);
  if (const auto node = fields.find("sensors")) load_sensors(*node, scene);
  if (const auto node = fields.find("characters")) load_characters(*node, scene);
  if (const auto node = fields.find("vehicles")) load_vehicles(*node, scene, names);
  if (const auto node = fields.find("soft_bodies")) load_soft_bodies(*node, scene);
  if (const auto node = fields.find("fields")) load_fields(*node, scene);
  if (const auto node = fields.find("queries")) load_queries(*node, scene, names);
  if (const auto node = fields.find("effects")) load_effects(*node, scene);
  if (const auto node = fields.find("checks")) load_checks(*node, scene);
  if (const auto node = fields.find("outputs")) load_outputs(*node, scene);
  if (const auto node = fields.find("expect")) load_expect(*node, scene);
  fields.finish();
  return scene;
}

Scene load_scene(const std::string& path) {
  return parse_scene(read_text_file(path), path);
}

}  // namespace boxstream::scenes
