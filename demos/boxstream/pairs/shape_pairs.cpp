// SPDX-License-Identifier: MIT
#include "boxstream/pairs/shape_pairs.hpp"

#include <fmt/format.h>

#include <boxstream/ccd.hpp>
#include <boxstream/detector.hpp>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "base/words.hpp"
#include "boxstream/shared/print.hpp"
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::tool {
namespace {

/// A convex shape somewhere.
struct PlacedShape {
  std::string name;  // may be empty
  ccd::Shape shape;
  ccd::Pose pose;
};

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

/// Reads "shapes" and "bodies" as they are in scenes (demos/scenes/README.md), convex shapes only, bodies with "name",
/// "shape", "position" and "rotation". Throws scenes::SceneError.
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

std::string label(const std::vector<PlacedShape>& shapes, std::uint32_t index) {
  return shapes[index].name.empty() ? std::to_string(index) : files::printable(shapes[index].name);
}

/// 0 in place of what rounding leaves of it.
double plain(double part_of_unit) {
  return std::abs(part_of_unit) < 1e-12 ? 0 : part_of_unit;
}

std::string doubt(ccd::Status status) {
  return status == ccd::Status::ok ? "" : fmt::format(" ({})", name(status));
}

}  // namespace

int shape_pairs(const std::string& text, const std::string& name, bool list, const NarrowOptions& options) {
  const std::vector<PlacedShape> shapes = parse_shapes(text, name);
  std::vector<Aabb64> boxes;
  for (const PlacedShape& s : shapes) boxes.push_back(bounds(s.shape, s.pose));
  ccd::Options narrow;
  narrow.tolerance = options.tolerance;
  narrow.max_iterations = options.iterations;
  narrow.solver = options.solver == "gjk"   ? ccd::Options::Solver::gjk
                  : options.solver == "mpr" ? ccd::Options::Solver::mpr
                                            : ccd::Options::Solver::automatic;

  std::uint64_t box_pairs = 0, touching = 0, doubtful = 0;
  Detector detector;
  detector.stream_pairs(Span<const Aabb64>(boxes.data(), boxes.size()), [&](Span<const Pair> pairs) {
    std::string lines;
    for (const Pair pair : pairs) {
      const PlacedShape &a = shapes[pair.a], &b = shapes[pair.b];
      ++box_pairs;
      const ccd::Penetration p = penetration(a.shape, a.pose, b.shape, b.pose, narrow);
      touching += p.intersects ? 1 : 0;
      ccd::Status status = p.status;
      if (list) fmt::format_to(std::back_inserter(lines), "{} {} ", label(shapes, pair.a), label(shapes, pair.b));
      if (p.intersects) {
        const Eigen::Vector3d& n = p.direction;
        if (list)
          fmt::format_to(std::back_inserter(lines), "touch depth {:.9g} direction {:.6g} {:.6g} {:.6g} by {}", p.depth,
                         plain(n.x()), plain(n.y()), plain(n.z()), ccd::name(p.method));
      } else if (list) {
        const ccd::Distance d = distance(a.shape, a.pose, b.shape, b.pose, narrow);
        status = d.status;
        fmt::format_to(std::back_inserter(lines), "apart distance {:.9g}", d.distance);
      }
      doubtful += status == ccd::Status::ok ? 0 : 1;
      if (list) lines += doubt(status) + "\n";
    }
    if (list) print(lines);
    return true;
  });
  if (!list)
    print(fmt::format("shapes {}, pairs of boxes {}, of shapes {}{}\n", shapes.size(), box_pairs, touching,
                      doubtful > 0 ? fmt::format(", inexact {}", doubtful) : ""));
  return 0;
}

}  // namespace boxstream::tool
