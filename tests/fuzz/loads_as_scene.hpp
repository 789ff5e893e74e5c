// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "finding.hpp"
#include "formats/import/fragment.hpp"
#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/scene.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::fuzz {

/// What an importer made is good JSON, and the loader takes it for a scene or says in one line why not. Returns how
/// many bodies the scene has, 0 without one.
inline std::size_t bodies_as_scene(const imports::Fragment& fragment) {
  imports::Json blocks = imports::Json::parse(fragment.text(), nullptr, false);
  promise(!blocks.is_discarded(), "a fragment that is no JSON");
  blocks.erase("notes");
  blocks.erase("gravity");
  imports::Json scene = imports::Json::parse(R"({"format": 1, "meta": {"name": "n", "about": "a"},
    "time": {"dt": 0.01}, "world": {"bounds": {"min": [-5, -5, -5], "max": [5, 5, 5]}}})");
  scene.update(blocks);
  try {
    const scenes::Expanded expanded = expand(scenes::parse_scene(scene.dump(), "/nowhere/fuzz.json"));
    promise(expanded.bodies.size() == blocks["bodies"].size(), "bodies were lost on the way to the scene");
    return expanded.bodies.size();
  } catch (const scenes::SceneError& error) {
    promise_one_line(error.what());
    return 0;
  }
}

}  // namespace boxstream::fuzz
