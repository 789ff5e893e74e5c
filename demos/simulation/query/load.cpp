// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>

#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_parts.hpp"
#include "simulation/query/objects.hpp"
#include "simulation/query/scene.hpp"

namespace boxstream::query {
namespace {

using scenes::any_place;
using scenes::any_size;
using scenes::Fields;
using scenes::max_count;
using scenes::max_length;
using scenes::Node;

using NamesOf = std::map<std::string, std::size_t>;

constexpr scenes::Range any_degrees{-360, 360};
constexpr scenes::Range not_negative{0, max_length};

/// Shapes that are described in fewer words than the meshes they become.
struct Ring {
  static constexpr const char* kind = "ring";
};
struct Bracket {
  static constexpr const char* kind = "bracket";
};
using DescribedShape = std::variant<scenes::BoxShape, scenes::SphereShape, scenes::CapsuleShape, scenes::CylinderShape,
                                    scenes::ConeShape, scenes::MeshShape, Ring, Bracket>;

struct ReadShape {
  Fields& fields;
  ShapeValue& shape;

  void operator()(Ring&) const {
    const double radius = fields.number("radius", any_size);
    const Node tube = fields.require("tube");
    if (!(tube.number(any_size) < radius)) tube.fail("must be less than \"radius\"");
    const int around = fields.integer("around", 16, 3, 1000);
    shape = ring_mesh(radius, tube.number(any_size), around, fields.integer("across", 8, 3, 1000));
  }
  void operator()(Bracket&) const {
    const double length = fields.number("length", any_size);
    const double width = fields.number("width", any_size);
    const Node thickness = fields.require("thickness");
    if (!(thickness.number(any_size) < length)) thickness.fail("must be less than \"length\"");
    shape = bracket_mesh(length, width, thickness.number(any_size));
  }
  template <class Shared>
  void operator()(Shared& shared) const {
    read(fields, shared);
    shape = std::move(shared);
  }
};

NamesOf load_shapes(const Node& node, QueryScene& scene) {
  NamesOf names;
  for (const Node& item : node.list(0, 1000)) {
    Fields fields(item);
    const Node name = fields.require("name");
    if (!names.emplace(name.text(), scene.shapes.size()).second)
      name.fail("a second shape called \"" + name.text() + "\"");
    DescribedShape described;
    read_kind(fields, described, ReadShape{fields, scene.shapes.emplace_back()});
    fields.finish();
  }
  return names;
}

struct ReadActor {
  Fields& fields;
  const NamesOf& shapes;

  void operator()(Scatter& scatter) const {
    scatter.count = fields.require("count").integer(0, max_count);
    scatter.origin = fields.require("origin").vec3(any_place);
    scatter.size = fields.require("size").vec3(any_size);
    scatter.turned = fields.boolean("turned", false);
    scatter.shake = fields.number("shake", 0, not_negative);
    scatter.degrees = fields.number("degrees", 0, any_degrees);
    for (const Node& item : fields.require("mix").list(1, 100)) {
      Fields entry(item);
      MixEntry& added = scatter.mix.emplace_back();
      added.shape = scenes::look_up(shapes, entry.require("shape"), "shape");
      added.weight = entry.number("weight", 1, scenes::positive(1e6));
      entry.finish();
    }
  }
  void operator()(Bin& bin) const {
    bin.origin = fields.require("origin").vec3(any_place);
    bin.size = fields.require("size").vec3(any_size);
    bin.thickness = fields.number("thickness", bin.thickness, any_size);
  }
  void operator()(Gripper& gripper) const {
    gripper.fingers = fields.integer("fingers", gripper.fingers, 1, 100);
    gripper.size = fields.number("size", gripper.size, any_size);
    for (const Node& point : fields.require("path").list(1, 10'000)) gripper.path.push_back(point.vec3(any_place));
    gripper.leg = fields.integer("leg", gripper.leg, 1, 1'000'000);
    gripper.degrees = fields.number("degrees", gripper.degrees, any_degrees);
  }
  void operator()(Arm& arm) const {
    arm.base = fields.require("base").vec3(any_place);
    arm.links = fields.integer("links", arm.links, 1, 1000);
    arm.length = fields.number("length", arm.length, any_size);
    arm.radius = fields.number("radius", arm.radius, any_size);
    arm.degrees = fields.number("degrees", arm.degrees, any_degrees);
    arm.period = fields.integer("period", arm.period, 1, 1'000'000);
  }
  void operator()(Convoy& convoy) const {
    convoy.vehicles = fields.require("vehicles").integer(1, max_count / 10);
    convoy.lanes = fields.integer("lanes", convoy.lanes, 1, 100);
    convoy.lane_width = fields.number("lane_width", convoy.lane_width, any_size);
    convoy.gap = fields.number("gap", convoy.gap, not_negative);
    convoy.speed = fields.number("speed", convoy.speed, not_negative);
    convoy.sway = fields.number("sway", convoy.sway, not_negative);
  }
};

NamesOf load_groups(const Node& node, QueryScene& scene, const NamesOf& shapes) {
  NamesOf names;
  double bodies = 0;
  for (const Node& item : node.list(1, 100)) {
    Fields fields(item);
    const Node name = fields.require("name");
    if (!names.emplace(name.text(), scene.groups.size()).second)
      name.fail("a second group called \"" + name.text() + "\"");
    Group& group = scene.groups.emplace_back();
    group.name = name.text();
    group.margin = fields.number("margin", 0, not_negative);
    for (const Node& actor : fields.require("objects").list(1, 1000)) {
      Fields parts(actor);
      read_kind(parts, group.actors.emplace_back(), ReadActor{parts, shapes});
      parts.finish();
      if (const auto* const scatter = std::get_if<Scatter>(&group.actors.back())) bodies += scatter->count;
      if (bodies > max_count) actor.fail("more than " + std::to_string(max_count) + " bodies in all");
    }
    fields.finish();
  }
  return names;
}

void load_queries(const Node& node, QueryScene& scene, const NamesOf& groups) {
  for (const Node& item : node.list(1, 100)) {
    Fields fields(item);
    Query query;
    const Node kind = fields.require("kind");
    query.kind = std::array{Kind::collide, Kind::first, Kind::distance,
                            Kind::within}[kind.choice({"collide", "first", "distance", "within"})];
    query.a = scenes::look_up(groups, fields.require("a"), "group");
    const auto b = fields.find("b");
    if (b) query.b = scenes::look_up(groups, *b, "group");
    if (b && *query.b == query.a) b->fail("the same group as \"a\": leave it out to ask for pairs within it");
    if (query.kind == Kind::distance && !b) kind.fail("a distance is between two groups: \"b\" is missing");
    if (const auto node_each = fields.find("each_object")) {
      query.each_object = node_each->boolean();
      if (query.each_object && !b) node_each->fail("objects are queried against a group \"b\"");
    }
    if (query.kind == Kind::within) {
      const Node limit = fields.require("limit");
      query.limit = limit.number(any_size);
      const double reach = (scene.groups[query.a].margin + scene.groups[query.b.value_or(query.a)].margin) / 2;
      if (query.limit > reach) limit.fail("the boxes do not reach that far: give the groups a \"margin\" of as much");
    }
    query.contacts = fields.integer("contacts", query.contacts, 1, 1'000'000);
    const std::string pair =
        b ? scene.groups[query.a].name + " - " + scene.groups[*query.b].name : scene.groups[query.a].name + " itself";
    query.name = fields.text("name", pair + ", " + kind.text());
    fields.finish();
    scene.queries.push_back(std::move(query));
  }
}

void load_meta(const Node& node, QueryScene& scene) {
  Fields fields(node);
  scene.meta.name = fields.require("name").text();
  scene.meta.about = fields.require("about").text();
  scene.meta.source = fields.text("source", "");
  fields.finish();
}

}  // namespace

QueryScene parse_query_scene(const std::string& text, const std::string& name) {
  const nlohmann::json document = scenes::parse_json(text, name);
  Fields fields(Node(document, "", name));
  fields.require("format").integer(1, 1);
  QueryScene scene;
  scene.file = name;
  load_meta(fields.require("meta"), scene);
  scene.steps = fields.integer("steps", scene.steps, 1, 10'000'000);
  if (const auto seed = fields.find("seed")) scene.seed = seed->count();
  NamesOf shapes;
  if (const auto node = fields.find("shapes")) shapes = load_shapes(*node, scene);
  const NamesOf groups = load_groups(fields.require("groups"), scene, shapes);
  load_queries(fields.require("queries"), scene, groups);
  fields.finish();
  return scene;
}

QueryScene load_query_scene(const std::string& path) {
  return parse_query_scene(scenes::read_text_file(path), path);
}

QueryScene scaled(QueryScene scene, double factor) {
  const auto count = [factor](int whole) {
    return static_cast<int>(std::clamp(std::round(whole * factor), whole > 0 ? 1.0 : 0.0, double{max_count}));
  };
  for (Group& group : scene.groups) {
    for (Actor& actor : group.actors) {
      if (auto* const scatter = std::get_if<Scatter>(&actor)) {
        // By what the count really is, so that rounding leaves the density alone.
        const double side = scatter->count > 0 ? std::cbrt(double(count(scatter->count)) / scatter->count) : 1;
        scatter->count = count(scatter->count);
        for (double& s : scatter->size) s *= side;
      } else if (auto* const bin = std::get_if<Bin>(&actor)) {
        for (double& s : bin->size) s *= std::cbrt(factor);
      } else if (auto* const convoy = std::get_if<Convoy>(&actor)) {
        convoy->vehicles = count(convoy->vehicles);
      }
    }
  }
  return scene;
}

}  // namespace boxstream::query
