// SPDX-License-Identifier: MIT
#include "boxstream/pairs/shapes_file.hpp"

#include <set>

#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::tool {
namespace {

using Eigen::Vector3d;

struct ToConvex {
  const scenes::Node& node;  // for messages

  ccd::Shape operator()(const scenes::BoxShape& s) const {
    return ccd::Box{{s.half_extents[0], s.half_extents[1], s.half_extents[2]}};
  }
  ccd::Shape operator()(const scenes::SphereShape& s) const { return ccd::Sphere{s.radius}; }
  ccd::Shape operator()(const scenes::CapsuleShape& s) const { return ccd::Capsule{s.radius, s.height}; }
  ccd::Shape operator()(const scenes::CylinderShape& s) const { return ccd::Cylinder{s.radius, s.height}; }
  ccd::Shape operator()(const scenes::ConeShape& s) const { return ccd::Cone{s.radius, s.height}; }
  ccd::Shape operator()(const scenes::HullShape& s) const {
    ccd::ConvexHull hull;
    for (const scenes::Vec3& p : s.points) hull.points.emplace_back(p[0], p[1], p[2]);
    return hull;
  }
  template <class Other>
  ccd::Shape operator()(const Other&) const {
    node.fail("only convex shapes can be tested: box, sphere, capsule, cylinder, cone, hull");
  }
};

/// Scenes have round shapes along y, the narrow phase along z.
bool lies_along_y(const ccd::Shape& shape) {
  return std::holds_alternative<ccd::Capsule>(shape) || std::holds_alternative<ccd::Cylinder>(shape) ||
         std::holds_alternative<ccd::Cone>(shape);
}

}  // namespace

std::vector<PlacedShape> parse_shapes(const std::string& text, const std::string& name) {
  const nlohmann::json document = scenes::parse_json(text, name);
  scenes::Fields fields(scenes::Node(document, "", name));
  fields.require("format").integer(1, 1);
  scenes::Scene scene;
  scenes::Names names;
  scenes::load_shapes(fields.require("shapes"), scene, names);
  std::vector<PlacedShape> placed;
  std::set<std::string> taken;
  Eigen::Matrix3d z_to_y;
  z_to_y << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  for (const scenes::Node& item : fields.require("bodies").list(0, scenes::max_count)) {
    scenes::Fields body(item);
    PlacedShape& added = placed.emplace_back();
    if (const auto node = body.find("name")) {
      added.name = node->text();
      if (!taken.insert(added.name).second) node->fail("a second body called \"" + added.name + "\"");
    }
    const scenes::Node shape = body.require("shape");
    added.shape = std::visit(ToConvex{shape}, scene.shapes[scenes::look_up(names.shapes, shape, "shape")].value);
    const scenes::Vec3 position = body.vec3("position", {}, scenes::any_place);
    const scenes::Quat q = scenes::read_rotation(body);
    const Eigen::Matrix3d turn = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix();
    added.pose = {lies_along_y(added.shape) ? Eigen::Matrix3d(turn * z_to_y) : turn,
                  Vector3d(position[0], position[1], position[2])};
    body.finish();
  }
  fields.finish();
  return placed;
}

}  // namespace boxstream::tool
