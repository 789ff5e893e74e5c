// SPDX-License-Identifier: MIT
#include "knob.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "base/words.hpp"
#include "formats/scene_model/names.hpp"
#include "formats/scene_model/scene.hpp"

namespace boxstream::accuracy {
namespace {

using nlohmann::json;
using scenes::Scene;

/// A key of a scene's file that needs no pointer.
struct NamedKey {
  std::string pointer;
  json (*value)(const Scene& scene);  ///< what the scene has there, by default too; null: only its file says it
};

const std::map<std::string, NamedKey>& named_keys() {
  static const std::map<std::string, NamedKey> all{
      {"bounces",
       {"/solver/bounces",
        [](const Scene& s) { return json(scenes::bounces_names().at(static_cast<std::size_t>(s.solver.bounces))); }}},
      {"cache_friction", {"/solver/cache_friction", [](const Scene& s) { return json(s.solver.cache_friction); }}},
      {"contact_erp", {"/solver/contact_erp", [](const Scene& s) { return json(s.solver.contact_erp); }}},
      {"dt", {"/time/dt", [](const Scene& s) { return json(s.time.dt); }}},
      {"erp", {"/solver/erp", [](const Scene& s) { return json(s.solver.erp); }}},
      {"friction_directions",
       {"/solver/friction_directions",
        [](const Scene& s) {
          return json(scenes::friction_directions_names().at(static_cast<std::size_t>(s.solver.friction_directions)));
        }}},
      {"iterations", {"/solver/iterations", [](const Scene& s) { return json(s.solver.iterations); }}},
      {"margin", {"/shapes/*/margin", nullptr}},
      {"precision",
       {"/solver/precision",
        [](const Scene& s) {
          return json(scenes::precision_names().at(static_cast<std::size_t>(s.solver.precision)));
        }}},
      {"residual", {"/solver/residual", [](const Scene& s) { return json(s.solver.residual); }}},
      {"slop", {"/solver/slop", [](const Scene& s) { return json(s.solver.slop); }}},
      {"solver",
       {"/solver/kind",
        [](const Scene& s) { return json(scenes::solver_names().at(static_cast<std::size_t>(s.solver.kind))); }}},
      {"split_impulse", {"/solver/split_impulse", [](const Scene& s) { return json(s.solver.split_impulse); }}},
      {"step", {"/time/dt", [](const Scene& s) { return json(s.time.dt); }}},
      {"substeps", {"/time/substeps", [](const Scene& s) { return json(s.time.substeps); }}},
      {"warmstart", {"/solver/warmstart", [](const Scene& s) { return json(s.solver.warmstart); }}},
  };
  return all;
}

/// "1/60": most steps are no decimal number.
std::optional<double> fraction(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  const json above = json::parse(text.substr(0, slash), nullptr, false);
  const json below = json::parse(text.substr(slash + 1), nullptr, false);
  if (!above.is_number() || !below.is_number() || below.get<double>() == 0) return std::nullopt;
  return above.get<double>() / below.get<double>();
}

json value_of(const std::string& text) {
  if (const std::optional<double> value = fraction(text)) return *value;
  const json value = json::parse(text, nullptr, /*allow_exceptions=*/false);
  const bool plain = value.is_boolean() || value.is_number();
  if (value.is_number_float() && !std::isfinite(value.get<double>())) throw BadKnob("not a finite number: " + text);
  return plain ? value : json(text);
}

/// Balls, capsules and surfaces have none.
bool has_margin(const json& shape) {
  for (const char* kind : {"box", "cylinder", "cone", "hull"})
    if (shape.is_object() && shape.value("type", "") == kind) return true;
  return false;
}

/// Appends the pointers that one with "*" for an element stands for.
void expand(const json& scene, const Knob& knob, const std::string& pointer, std::vector<std::string>& all) {
  const std::size_t star = (pointer + "/").find("/*/");
  if (star == std::string::npos) {
    all.push_back(pointer);
    return;
  }
  const json::json_pointer list(pointer.substr(0, star));
  if (!scene.contains(list) || !scene[list].is_array()) throw BadKnob(knob.name + ": no list where the * is");
  for (std::size_t i = 0; i < scene[list].size(); ++i)
    if (knob.name != "margin" || has_margin(scene[list][i]))
      expand(scene, knob, pointer.substr(0, star + 1) + std::to_string(i) + pointer.substr(star + 2), all);
}

/// The value that a pointer names; made where an object lacks the key.
json& value_at(json& scene, const Knob& knob, const json::json_pointer& pointer) try {
  json::json_pointer known = pointer;
  while (!known.empty() && !scene.contains(known)) known.pop_back();
  if (known == pointer || scene[known].is_object() || scene[known].is_null()) return scene[pointer];
  throw BadKnob(knob.name + ": the scene has no such place");
} catch (const json::exception&) {  // an index beyond all numbers
  throw BadKnob(knob.name + ": the scene has no such place");
}

/// Files round what is no decimal number, such as 1/60.
bool are_alike(const json& a, const json& b) {
  if (!a.is_number() || !b.is_number()) return a == b;
  const double x = a.get<double>(), y = b.get<double>();
  return std::abs(x - y) <= 1e-5 * std::max(std::abs(x), std::abs(y));
}

bool is_own(const json& document, const Scene& scene, const Knob& knob, const json& value) {
  for (const auto& [name, key] : named_keys())
    if (key.pointer == knob.pointer && key.value != nullptr) return are_alike(key.value(scene), value);
  std::vector<std::string> paths;
  expand(document, knob, knob.pointer, paths);
  return std::all_of(paths.begin(), paths.end(), [&](const std::string& path) {
    const json::json_pointer pointer(path);
    return document.contains(pointer) ? are_alike(document[pointer], value) : value.is_null();
  });
}

}  // namespace

std::vector<std::string> knob_names() {
  std::vector<std::string> names;
  for (const auto& [name, key] : named_keys()) names.push_back(name);
  return names;
}

Knob parse_knob(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    throw BadKnob(text + ": a knob is NAME=VALUE,VALUE...");
  Knob knob;
  knob.name = text.substr(0, equals);
  if (knob.name[0] == '/') {
    knob.pointer = knob.name;
    try {
      (void)json::json_pointer(knob.pointer);
    } catch (const json::exception&) {
      throw BadKnob(knob.name + ": no JSON pointer");
    }
  } else {
    const auto found = named_keys().find(knob.name);
    if (found == named_keys().end())
      throw BadKnob(unknown_word("knob", knob.name, knob_names()) +
                    " (or a pointer into the scene such as /materials/NAME/friction)");
    knob.pointer = found->second.pointer;
  }
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    if (end == begin) throw BadKnob(knob.name + ": an empty value");
    knob.values.push_back(value_of(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (text.back() == ',') throw BadKnob(knob.name + ": an empty value");
  if (std::set<json>(knob.values.begin(), knob.values.end()).size() != knob.values.size())
    throw BadKnob(knob.name + ": a value twice");
  return knob;
}

std::vector<Setting> grid(const std::vector<Knob>& knobs) {
  std::vector<Setting> all{{}};
  for (const Knob& knob : knobs) {
    std::vector<Setting> longer;
    for (const Setting& setting : all)
      for (const json& value : knob.values) {
        longer.push_back(setting);
        longer.back().push_back(value);
      }
    all = std::move(longer);
  }
  return all;
}

std::string text_of(const Knob& knob, const json& value) {
  const auto place = std::find(knob.values.begin(), knob.values.end(), value) - knob.values.begin();
  if (static_cast<std::size_t>(place) < knob.labels.size()) return knob.labels[static_cast<std::size_t>(place)];
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string label(const std::vector<Knob>& knobs, const Setting& setting) {
  std::string text;
  for (std::size_t i = 0; i < setting.size(); ++i)
    text += (i == 0 ? "" : " ") + knobs[i].name + "=" + text_of(knobs[i], setting[i]);
  return text;
}

json with(json scene, const std::vector<Knob>& knobs, const Setting& setting) {
  for (std::size_t i = 0; i < setting.size(); ++i) {
    std::vector<std::string> paths;
    expand(scene, knobs[i], knobs[i].pointer, paths);
    for (const std::string& path : paths) {
      const json::json_pointer pointer(path);
      value_at(scene, knobs[i], pointer) = setting[i];
      if (!setting[i].is_null()) continue;
      if (json& parent = scene[pointer.parent_pointer()]; parent.is_object()) parent.erase(pointer.back());
    }
  }
  return scene;
}

bool is_own(const json& document, const Scene& scene, const std::vector<Knob>& knobs, const Setting& setting) {
  for (std::size_t i = 0; i < setting.size(); ++i)
    if (!is_own(document, scene, knobs[i], setting[i])) return false;
  return true;
}

}  // namespace boxstream::accuracy
