// SPDX-License-Identifier: MIT
#include "scene/load_parts.hpp"

namespace boxstream::scenes {
namespace {

constexpr Range any_density{0, 1e5};
constexpr Range any_rate{0, 100};
constexpr Range any_drag{0, 1e6};

SwirlField read_swirl(Fields& fields) {
  SwirlField swirl;
  swirl.centre = fields.vec3("centre", swirl.centre, any_place);
  swirl.radius = fields.number("radius", any_size);
  swirl.height = fields.number("height", any_size);
  swirl.speed = fields.number("speed", any_velocity);
  swirl.updraft = fields.number("updraft", any_velocity);
  swirl.rate = fields.number("rate", any_rate);
  return swirl;
}

WindField read_wind(Fields& fields) {
  WindField wind;
  wind.velocity = fields.require("velocity").vec3(any_velocity);
  wind.density = fields.number("density", wind.density, any_density);
  wind.coefficient = fields.number("coefficient", wind.coefficient, {0, 100});
  return wind;
}

DragField read_drag(Fields& fields) {
  DragField drag;
  drag.linear = fields.number("linear", drag.linear, any_drag);
  drag.quadratic = fields.number("quadratic", drag.quadratic, any_drag);
  drag.angular = fields.number("angular", drag.angular, any_drag);
  return drag;
}

BuoyancyField read_buoyancy(Fields& fields) {
  BuoyancyField buoyancy;
  buoyancy.level = fields.number("level", any_place);
  buoyancy.density = fields.number("density", buoyancy.density, any_density);
  buoyancy.drag = fields.number("drag", buoyancy.drag, any_rate);
  return buoyancy;
}

KicksField read_kicks(Fields& fields) {
  KicksField kicks;
  kicks.share = fields.number("share", positive(1));
  kicks.speed = fields.number("speed", {0, max_speed});
  return kicks;
}

Field read_field(Fields& fields) {
  switch (fields.require("type").choice({"swirl", "wind", "drag", "buoyancy", "kicks"})) {
    case 0:
      return read_swirl(fields);
    case 1:
      return read_wind(fields);
    case 2:
      return read_drag(fields);
    case 3:
      return read_buoyancy(fields);
    default:
      return read_kicks(fields);
  }
}

}  // namespace

void load_fields(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 100)) {
    Fields fields(item);
    scene.fields.push_back(read_field(fields));
    fields.finish();
  }
}

}  // namespace boxstream::scenes
