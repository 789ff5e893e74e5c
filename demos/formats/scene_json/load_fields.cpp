// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

constexpr Range any_density{0, 1e5};
constexpr Range any_rate{0, 100};
constexpr Range any_drag{0, 1e6};

struct ReadField {
  Fields& fields;

  void operator()(VortexField& vortex) const {
    vortex.centre = fields.vec3("centre", vortex.centre, any_place);
    vortex.radius = fields.number("radius", any_size);
    vortex.height = fields.number("height", any_size);
    vortex.speed = fields.number("speed", any_velocity);
    vortex.updraft = fields.number("updraft", any_velocity);
    vortex.rate = fields.number("rate", any_rate);
  }
  void operator()(WindField& wind) const {
    wind.velocity = fields.require("velocity").vec3(any_velocity);
    wind.density = fields.number("density", wind.density, any_density);
    wind.coefficient = fields.number("coefficient", wind.coefficient, {0, 100});
  }
  void operator()(DragField& drag) const {
    drag.linear = fields.number("linear", drag.linear, any_drag);
    drag.quadratic = fields.number("quadratic", drag.quadratic, any_drag);
    drag.angular = fields.number("angular", drag.angular, any_drag);
    drag.density = fields.number("density", drag.density, any_density);
    drag.coefficient = fields.number("coefficient", drag.coefficient, {0, 100});
  }
  void operator()(BuoyancyField& buoyancy) const {
    buoyancy.level = fields.number("level", any_place);
    buoyancy.density = fields.number("density", buoyancy.density, any_density);
    buoyancy.drag = fields.number("drag", buoyancy.drag, any_rate);
  }
  void operator()(ImpulsesField& impulses) const {
    impulses.share = fields.number("share", positive(1));
    impulses.speed = fields.number("speed", {0, max_speed});
  }
};

struct ReadQuery {
  Fields& fields;
  const Names& names;

  void operator()(RayFan& fan) const {
    fan.count = fields.require("count").integer(1, max_count);
    fan.from = fields.require("from").vec3(any_place);
    fan.radius = fields.number("radius", any_size);
    fan.drop = fields.number("drop", any_size);
    fan.degrees = fields.number("degrees", fan.degrees, {-360, 360});
  }
  void operator()(BoxQuery& query) const { query.bounds = read_bounds(fields.require("bounds")); }
  void operator()(ContactQuery& query) const { query.body = look_up(names.bodies, fields.require("body"), "body"); }
};

}  // namespace

void load_fields(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 100)) {
    Fields fields(item);
    read_kind(fields, scene.fields.emplace_back(), ReadField{fields});
    fields.finish();
  }
}

void load_queries(const Node& node, Scene& scene, const Names& names) {
  for (const Node& item : node.list(0, 100)) {
    Fields fields(item);
    read_kind(fields, scene.queries.emplace_back(), ReadQuery{fields, names});
    fields.finish();
  }
}

}  // namespace boxstream::scenes
