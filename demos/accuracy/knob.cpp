// SPDX-License-Identifier: MIT
#include "knob.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace boxstream::accuracy {
namespace {

using nlohmann::json;

const std::map<std::string, std::string>& pointers() {
  static const std::map<std::string, std::string> all{
      {"cache_friction", "/solver/cache_friction"},
      {"contact_erp", "/solver/contact_erp"},
      {"dt", "/time/dt"},
      {"erp", "/solver/erp"},
      {"friction_directions", "/solver/friction_directions"},
      {"iterations", "/solver/iterations"},
      {"residual", "/solver/residual"},
      {"slop", "/solver/slop"},
      {"split_impulse", "/solver/split_impulse"},
      {"substeps", "/time/substeps"},
      {"warmstart", "/solver/warmstart"},
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

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// The pointers that one with "*" for an element stands for.
std::vector<std::string> pointers_of(const json& scene, const Knob& knob) {
  std::vector<std::string> all{knob.pointer};
  for (bool more = true; more;) {
    more = false;
    std::vector<std::string> longer;
    for (const std::string& pointer : all) {
      const std::size_t star = (pointer + "/").find("/*/");
      if (star == std::string::npos) {
        longer.push_back(pointer);
        continue;
      }
      const json::json_pointer list(pointer.substr(0, star));
      if (!scene.contains(list) || !scene[list].is_array()) throw BadKnob(knob.name + ": no list where the * is");
      for (std::size_t i = 0; i < scene[list].size(); ++i)
        longer.push_back(pointer.substr(0, star + 1) + std::to_string(i) + pointer.substr(star + 2));
      more = true;
    }
    all = std::move(longer);
  }
  return all;
}

/// The place that a pointer names, made where an object lacks the key.
json& place(json& scene, const Knob& knob, const std::string& path) {
  json* at = &scene;
  const json::json_pointer pointer(path);
  std::vector<std::string> keys;
  for (json::json_pointer rest = pointer; !rest.empty(); rest.pop_back()) keys.push_back(rest.back());
  std::reverse(keys.begin(), keys.end());
  for (const std::string& key : keys) {
    if (at->is_null()) *at = json::object();
    if (at->is_object()) {
      at = &(*at)[key];
    } else if (at->is_array() && !key.empty() && key.size() < 10 &&
               std::all_of(key.begin(), key.end(), [](char c) { return c >= '0' && c <= '9'; }) &&
               std::stoul(key) < at->size()) {
      at = &(*at)[std::stoul(key)];
    } else {
      throw BadKnob(knob.name + ": the scene has no such place");
    }
  }
  return *at;
}

}  // namespace

const std::vector<std::string>& knob_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& [name, pointer] : pointers()) all.push_back(name);
    return all;
  }();
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
    const auto found = pointers().find(knob.name);
    if (found == pointers().end())
      throw BadKnob(knob.name + ": no knob of this name; there are " + joined(knob_names()) +
                    ", and pointers into the scene such as /bodies/0/friction");
    knob.pointer = found->second;
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
  for (std::size_t i = 0; i < setting.size(); ++i)
    for (const std::string& path : pointers_of(scene, knobs[i])) {
      place(scene, knobs[i], path) = setting[i];
      if (!setting[i].is_null()) continue;
      const json::json_pointer pointer(path);
      if (json& parent = scene[pointer.parent_pointer()]; parent.is_object()) parent.erase(pointer.back());
    }
  return scene;
}

}  // namespace boxstream::accuracy
