// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

constexpr Range any_density{0, 1e5};
constexpr Range any_rate{0, 100};
constexpr Range any_drag{0, 1e6};

Field read_vortex(Fields& fields) {
  VortexField vortex;
  vortex.centre = fields.vec3("centre", vortex.centre, any_place);
  vortex.radius = fields.number("radius", any_size);
  vortex.height = fields.number("height", any_size);
  vortex.speed = fields.number("speed", any_velocity);
  vortex.updraft = fields.number("updraft", any_velocity);
  vortex.rate = fields.number("rate", any_rate);
  return vortex;
}

Field read_wind(Fields& fields) {
  WindField wind;
  wind.velocity = fields.require("velocity").vec3(any_velocity);
  wind.density = fields.number("density", wind.density, any_density);
  wind.coefficient = fields.number("coefficient", wind.coefficient, {0, 100});
  return wind;
}

Field read_drag(Fields& fields) {
  DragField drag;
  drag.linear = fields.number("linear", drag.linear, any_drag);
  drag.quadratic = fields.number("quadratic", drag.quadratic, any_drag);
  drag.angular = fields.number("angular", drag.angular, any_drag);
  return drag;
}

Field read_buoyancy(Fields& fields) {
  BuoyancyField buoyancy;
  buoyancy.level = fields.number("level", any_place);
  buoyancy.density = fields.number("density", buoyancy.density, any_density);
  buoyancy.drag = fields.number("drag", buoyancy.drag, any_rate);
  return buoyancy;
}

Field read_impulses(Fields& fields) {
  ImpulsesField impulses;
  impulses.share = fields.number("share", positive(1));
  impulses.speed = fields.number("speed", {0, max_speed});
  return impulses;
}

constexpr Kind<Field> kinds[] = {{"swirl", read_vortex},
                                 {"wind", read_wind},
                                 {"drag", read_drag},
                                 {"buoyancy", read_buoyancy},
                                 {"kicks", read_impulses}};

}  // namespace

void load_fields(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 100)) {
    Fields fields(item);
    scene.fields.push_back(read_kind(kinds, fields));
    fields.finish();
  }
}

}  // namespace boxstream::scenes
