// SPDX-License-Identifier: MIT
#include "gallery.hpp"

#include <ostream>

#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_scene.hpp"

namespace boxstream::effects_test {

using nlohmann::json;

const std::vector<Exhibit>& gallery() {
  constexpr Call falls{"gravity", "/world/gravity"}, touches{"contacts", "/bodies/0"},
      deep{"split_impulse", "/bodies/0"}, rubs{"friction", "/bodies/0"}, rests{"sleeping", "/bodies/0"},
      held{"joints", "/joints/0"};
  static const std::vector<Exhibit> exhibits{
      {"nothing", {}},
      {"gravity", {falls}},
      {"tumbling_gravity", {{"tumbling_gravity", "/world/gravity/script"}}},
      {"contacts", {falls, touches, deep}},
      {"friction", {falls, touches, deep, rubs}},
      {"anisotropic_friction",
       {falls, touches, deep, {"friction", "/bodies/2"}, {"anisotropic_friction", "/bodies/2"}}},
      {"rolling_friction", {falls, touches, deep, rubs, {"rolling_friction", "/bodies/0"}}},
      {"spinning_friction", {falls, touches, deep, rubs, {"spinning_friction", "/bodies/0"}}},
      {"friction_caching", {falls, touches, deep, rubs, {"friction_caching", "/solver/cache_friction"}}},
      {"restitution", {falls, touches, deep, {"restitution", "/bodies/0"}}},
      {"split_impulse", {falls, touches, deep}},
      {"damping", {{"damping", "/bodies/0"}}},
      {"ccd", {touches, deep, {"ccd", "/bodies/0"}, {"ccd_on_demand", "/bodies/0"}}},
      {"ccd_on_demand", {falls, touches, deep, {"ccd_on_demand", "/bodies/0"}}},
      {"sleeping", {falls, touches, deep, rests}},
      {"forced_boxes", {falls, touches, deep, rests, {"forced_boxes", "/broadphase/force_boxes"}}},
      {"gyroscopic", {{"gyroscopic", "/bodies/0"}}},
      {"kinematic", {touches, deep, {"kinematic", "/bodies/1"}}},
      {"planes", {falls, touches, deep, {"planes", "/bodies/1"}}},
      {"meshes", {falls, touches, deep, {"meshes", "/bodies/1"}}},
      {"heightfields", {falls, touches, deep, {"heightfields", "/bodies/1"}}},
      {"compounds", {falls, touches, deep, {"compounds", "/bodies/1"}}},
      {"internal_edges", {falls, touches, deep, {"meshes", "/bodies/1"}, {"internal_edges", "/bodies/1"}}},
      {"joints", {falls, held}},
      {"joint_limits", {falls, held, {"joint_limits", "/joints/0"}}},
      {"motors", {falls, held, {"motors", "/joints/0"}}},
      {"sensors", {{"sensors", "/sensors/0"}}},
      {"characters", {falls, {"contacts", "/characters/0"}, deep, {"characters", "/characters/0"}}},
      {"soft_bodies", {falls, {"contacts", "/soft_bodies/0"}, {"soft_bodies", "/soft_bodies/0"}}},
      {"vehicles", {falls, touches, deep, {"vehicles", "/vehicles/0"}}},
      {"vortex", {{"vortex", "/fields/0"}}},
      {"wind", {{"wind", "/fields/0"}}},
      {"drag", {{"drag", "/fields/0"}}},
      {"buoyancy", {falls, {"buoyancy", "/fields/0"}}},
      {"impulses", {{"impulses", "/fields/0"}}},
      {"respawn", {touches, deep, {"respawn", "/generators/0"}}},
      {"out_of_bounds", {{"out_of_bounds", "/world/on_leave"}}},
      {"collision_filters", {falls, {"collision_filters", "/bodies/1"}}},
      {"exclusions", {{"exclusions", "/exclusions/0"}}},
      {"queries", {{"queries", "/queries/0"}}},
      {"monitors", {{"monitors", "/checks/0"}}},
      {"recording", {{"recording", "/outputs/record/0"}}},
      {"threads", {touches, deep, {"threads", "/broadphase/threads"}}},
      {"conveyors", {falls, touches, deep, rubs, {"conveyors", "/bodies/1"}}},
      {"other_solver", {falls, touches, deep, {"other_solver", "/solver/kind"}}},
      {"bounces_on_contact",
       {falls, touches, deep, {"restitution", "/bodies/0"}, {"bounces_on_contact", "/solver/bounces"}}},
      {"unit_contacts", {falls, touches, deep, {"unit_contacts", "/bodies/2"}}},
      {"multibodies", {falls, held, {"multibodies", "/solver/kind"}}},
  };
  return exhibits;
}

void PrintTo(const Exhibit& exhibit, std::ostream* out) {
  *out << exhibit.name;
}

json document_of(const std::string& exhibit) {
  const std::string file = scenes::shipped("effects/" + exhibit + ".json");
  return scenes::parse_json(scenes::read_text_file(file), file);
}

scenes::Scene scene_of(const json& document) {
  return scenes::parse_scene(document.dump(), document["meta"]["name"]);
}

scenes::Scene exhibit(const std::string& name) {
  return scenes::load_scene(scenes::shipped("effects/" + name + ".json"));
}

namespace {

struct Conflict {};

bool is_named_list(const json& value) {
  return value.is_array() && !value.empty() && value[0].is_object() && value[0].contains("name");
}

/// By name, so that the same body in both is one body.
json as_object(const json& list) {
  json object = json::object();
  for (const json& item : list) object[item["name"].get<std::string>()] = item;
  return object;
}

json merge(const json& a, const json& b, const json& base);

/// Keeps the order of the first list, so that indices of what both have stay.
json merge_named(const json& a, const json& b, const json& base) {
  const json all = merge(as_object(a), as_object(b), as_object(base));
  json list = json::array();
  for (const json& item : a) list.push_back(all[item["name"].get<std::string>()]);
  const json first = as_object(a);
  for (const json& item : b)
    if (!first.contains(item["name"].get<std::string>())) list.push_back(item);
  return list;
}

json merge(const json& a, const json& b, const json& base) {
  if (a == b || b == base || b.is_null()) return a;
  if (a == base || a.is_null()) return b;
  if (is_named_list(a) && is_named_list(b)) return merge_named(a, b, base.is_null() ? json::array() : base);
  if (a.is_array() && b.is_array() && base.is_null() && !a[0].is_number()) {
    json list = a;
    list.insert(list.end(), b.begin(), b.end());
    return list;
  }
  if (!a.is_object() || !b.is_object()) throw Conflict();
  json object = a;
  const auto in_base = [&](const std::string& key) {
    return base.is_object() && base.contains(key) ? base[key] : json();
  };
  for (const auto& [key, value] : b.items()) object[key] = a.contains(key) ? merge(a[key], value, in_base(key)) : value;
  return object;
}

}  // namespace

std::optional<json> merged(const json& a, const json& b) {
  static const json base = [] {
    json nothing = document_of("nothing");
    nothing.erase("expect");
    return nothing;
  }();
  json first = a, second = b;
  // These speak of one scene as a whole.
  for (json* const document : {&first, &second}) {
    document->erase("expect");
    (*document)["meta"] = base["meta"];
  }
  try {
    return merge(first, second, base);
  } catch (const Conflict&) {
    return std::nullopt;
  }
}

Names on(const effects::Plan& plan) {
  Names names;
  for (const effects::Decision& decision : plan)
    if (decision.on) names.insert(decision.effect->name);
  return names;
}

Names names_of(const Exhibit& exhibit) {
  Names names;
  for (const Call& call : exhibit.calls) names.insert(call.effect);
  return names;
}

}  // namespace boxstream::effects_test
