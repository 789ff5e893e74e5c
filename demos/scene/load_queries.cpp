// SPDX-License-Identifier: MIT
#include "scene/load_parts.hpp"

namespace boxstream::scenes {
namespace {

RayFan read_rays(Fields& fields) {
  RayFan fan;
  fan.count = fields.require("count").integer(1, max_count);
  fan.from = fields.require("from").vec3(any_place);
  fan.radius = fields.number("radius", any_size);
  fan.drop = fields.number("drop", any_size);
  fan.degrees = fields.number("degrees", fan.degrees, {-360, 360});
  return fan;
}

Query read_query(Fields& fields, const Names& names) {
  switch (fields.require("type").choice({"rays", "box", "contact"})) {
    case 0:
      return read_rays(fields);
    case 1:
      return BoxQuery{read_bounds(fields.require("bounds"))};
    default:
      return ContactQuery{look_up(names.bodies, fields.require("body"), "body")};
  }
}

}  // namespace

void load_queries(const Node& node, Scene& scene, const Names& names) {
  for (const Node& item : node.list(0, 100)) {
    Fields fields(item);
    scene.queries.push_back(read_query(fields, names));
    fields.finish();
  }
}

}  // namespace boxstream::scenes
