// SPDX-License-Identifier: MIT
#include "hard_pose.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "faces.hpp"
#include "source_path.hpp"

namespace boxstream::poses {
namespace {

using nlohmann::json;
using Vec = Eigen::Vector3d;

Vec vec(const json& j) {
  return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()};
}

std::vector<Vec> box_corners(const std::array<double, 4>& sides) {
  std::vector<Vec> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(
        {(i & 1 ? 1 : -1) * sides[0] / 2, (i & 2 ? 1 : -1) * sides[1] / 2, (i & 4 ? 1 : -1) * sides[2] / 2});
  return corners;
}

/// Two copies of a polygon, one at each end.
std::vector<Vec> prism(const std::vector<std::array<double, 2>>& polygon, double half, bool along_x) {
  std::vector<Vec> corners;
  for (const double end : {half, -half})
    for (const auto& [u, v] : polygon) corners.push_back(along_x ? Vec(end, u, v) : Vec(u, v, end));
  return corners;
}

/// As published, where that is known: among corners that are equally far FCL takes the first.
void reorder(const json& j, std::vector<Vec>& points) {
  if (!j.contains("order")) return;
  const std::vector<Vec> unordered = points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = unordered.at(j["order"].at(i).get<std::size_t>());
}

/// With coordinates that are rounded as in a mesh file.
std::vector<std::array<double, 2>> regular_polygon(int sides, double radius, int decimals) {
  const double grid = std::pow(10, decimals);
  std::vector<std::array<double, 2>> polygon;
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    polygon.push_back(
        {std::round(radius * std::cos(angle) * grid) / grid, std::round(radius * std::sin(angle) * grid) / grid});
  }
  return polygon;
}

/// Spread evenly along a spiral.
std::vector<Vec> on_sphere(int count, double radius) {
  std::vector<Vec> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    points.push_back(radius * Vec(std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z));
  }
  return points;
}

void read_sizes(const json& j, Solid& solid) {
  if (j.is_number()) {
    solid.size[0] = j.get<double>();
    return;
  }
  for (std::size_t i = 0; i < j.size(); ++i) solid.size.at(i) = j[i].get<double>();
}

void read_shape(const json& j, Solid& solid) {
  static const std::pair<const char*, Kind> plain[] = {
      {"box", Kind::box},   {"sphere", Kind::sphere},         {"capsule", Kind::capsule},  {"cylinder", Kind::cylinder},
      {"cone", Kind::cone}, {"half_space", Kind::half_space}, {"mesh_box", Kind::mesh_box}};
  for (const auto& [name, kind] : plain) {
    if (!j.contains(name)) continue;
    solid.kind = kind;
    read_sizes(j[name], solid);
    if (kind == Kind::box || kind == Kind::mesh_box) solid.points = box_corners(solid.size);
    return;
  }
  if (j.contains("cells")) {
    solid.kind = Kind::cells;
    const double side = solid.size[0] = j["cells"].at("size").get<double>();
    for (const json& point : j["cells"].at("points"))
      solid.points.push_back(((vec(point) * (1 / side)).array().floor() + 0.5).matrix() * side);
    return;
  }
  solid.kind = Kind::hull;
  if (j.contains("prism")) {
    const json& p = j["prism"];
    solid.points = prism(p.at("polygon").get<std::vector<std::array<double, 2>>>(), p.at("half"), p.at("along") == "x");
    reorder(p, solid.points);
  } else if (j.contains("regular_prism")) {
    const json& p = j["regular_prism"];
    solid.points = prism(regular_polygon(p.at("sides"), p.at("radius"), p.at("decimals")), p.at("half"), true);
    reorder(p, solid.points);
  } else if (j.contains("ball_hull")) {
    solid.points = on_sphere(j["ball_hull"].at("points"), j["ball_hull"].at("radius"));
  } else {
    throw std::runtime_error("no shape");
  }
}

Solid solid_of(const json& j) {
  Solid solid;
  read_shape(j, solid);
  if (solid.kind != Kind::cells && !solid.points.empty()) solid.faces = faces_of(solid.points);
  solid.translation = vec(j.at("translation"));
  if (j.contains("rotation"))
    for (int row = 0; row < 3; ++row) solid.rotation.row(row) = vec(j["rotation"].at(static_cast<std::size_t>(row)));
  return solid;
}

Query query_of(const std::string& name) {
  if (name == "distance") return Query::distance;
  if (name == "signed distance") return Query::signed_distance;
  if (name == "contact") return Query::contact;
  throw std::runtime_error("no query: " + name);
}

Known known_of(const json& j) {
  return {j.at("outcome").get<std::string>(), j.value("value", std::numeric_limits<double>::quiet_NaN())};
}

HardPose pose_of(const json& j) {
  HardPose pose;
  pose.name = j.at("name");
  pose.row = j.at("row");
  pose.source = j.at("source");
  pose.own = j.value("own", "");
  pose.query = query_of(j.at("query"));
  pose.a = solid_of(j.at("a"));
  pose.b = solid_of(j.at("b"));
  pose.truth = j.at("truth");
  pose.known = j.at("known");
  pose.libccd = known_of(j.at("libccd"));
  pose.indep = known_of(j.at("indep"));
  return pose;
}

}  // namespace

std::vector<HardPose> load(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be read");
  const json document = json::parse(in);
  std::vector<HardPose> poses;
  for (const json& j : document.at("poses")) {
    try {
      poses.push_back(pose_of(j));
    } catch (const std::exception& error) {
      throw std::runtime_error(file + ": /poses/" + std::to_string(poses.size()) + ": " + error.what());
    }
  }
  return poses;
}

const std::vector<HardPose>& all() {
  static const std::vector<HardPose> poses = load(tests::source_path("tests/lab/poses/poses.json"));
  return poses;
}

std::vector<Solid> parts(const Solid& solid) {
  if (solid.kind != Kind::cells && solid.kind != Kind::mesh_box) return {solid};
  const double side = solid.size[0];
  Solid box = solid;
  box.kind = Kind::box;
  if (solid.kind == Kind::mesh_box) return {box};
  box.size = {side, side, side, 0};
  box.points = box_corners(box.size);
  box.faces = faces_of(box.points);
  std::vector<Solid> boxes;
  for (const Vec& centre : solid.points) {
    boxes.push_back(box);
    boxes.back().translation = solid.rotation * centre + solid.translation;
  }
  return boxes;
}

std::string text(const Solid& solid) {
  static const char* const names[] = {"box",  "sphere",     "capsule",          "cylinder", "cone",
                                      "hull", "half-space", "box of triangles", "octree"};
  static const int sizes[] = {3, 1, 2, 2, 2, 0, 0, 3, 1};
  std::ostringstream out;
  out.precision(4);
  const auto kind = static_cast<std::size_t>(solid.kind);
  out << names[kind];
  for (int i = 0; i < sizes[kind]; ++i) out << (i ? " x " : " ") << solid.size[static_cast<std::size_t>(i)];
  if (solid.kind == Kind::hull) out << " of " << solid.points.size();
  return out.str();
}

}  // namespace boxstream::poses
