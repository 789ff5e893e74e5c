// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

struct ReadSoft {
  Fields& fields;

  void operator()(ClothSoft& cloth) const {
    const std::vector<Node> corners = fields.require("corners").list(4, 4);
    for (std::size_t i = 0; i < 4; ++i) cloth.corners[i] = corners[i].vec3(any_place);
    const std::vector<Node> resolution = fields.require("resolution").list(2, 2);
    cloth.resolution = {resolution[0].integer(2, 1000), resolution[1].integer(2, 1000)};
    if (const auto pinned = fields.find("pinned"))
      for (const Node& corner : pinned->list(0, 4)) cloth.pinned |= 1 << corner.integer(0, 3);
  }
  void operator()(BallSoft& ball) const {
    ball.centre = fields.require("centre").vec3(any_place);
    ball.radius = fields.number("radius", any_size);
    ball.resolution = fields.integer("resolution", 128, 8, 100'000);
    ball.pressure = fields.number("pressure", 0, {0, 1e7});
  }
};

}  // namespace

void load_soft_bodies(const Node& node, Scene& scene) {
  for (const Node& item : node.list(0, 1000)) {
    Fields fields(item);
    SoftBody soft;
    soft.name = fields.text("name", "");
    soft.mass = fields.number("mass", positive(max_mass));
    soft.stiffness = fields.number("stiffness", soft.stiffness, {0, 1});
    soft.damping = fields.number("damping", soft.damping, {0, 1});
    soft.friction = fields.number("friction", soft.friction, {0, 1});
    soft.margin = fields.number("margin", soft.margin, any_size);
    soft.iterations = fields.integer("iterations", soft.iterations, 1, 100);
    read_kind(fields, soft.value, ReadSoft{fields});
    fields.finish();
    scene.soft_bodies.push_back(std::move(soft));
  }
}

}  // namespace boxstream::scenes
