// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

Query read_rays(Fields& fields, const Names&) {
  RayFan fan;
  fan.count = fields.require("count").integer(1, max_count);
  fan.from = fields.require("from").vec3(any_place);
  fan.radius = fields.number("radius", any_size);
  fan.drop = fields.number("drop", any_size);
  fan.degrees = fields.number("degrees", fan.degrees, {-360, 360});
  return fan;
}

Query read_box(Fields& fields, const Names&) {
  return BoxQuery{read_bounds(fields.require("bounds"))};
}

Query read_contact(Fields& fields, const Names& names) {
  return ContactQuery{look_up(names.bodies, fields.require("body"), "body")};
}

constexpr Kind<Query, const Names&> kinds[] = {{"rays", read_rays}, {"box", read_box}, {"contact", read_contact}};

}  // namespace

void load_queries(const Node& node, Scene& scene, const Names& names) {
  for (const Node& item : node.list(0, 100)) {
    Fields fields(item);
    scene.queries.push_back(read_kind(kinds, fields, names));
    fields.finish();
  }
}

}  // namespace boxstream::scenes
