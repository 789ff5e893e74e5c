// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>

#include "formats/geometry/frame.hpp"
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_json/load_parts.hpp"
#include "formats/scene_model/random.hpp"

namespace boxstream::scenes {
namespace {

using geometry::cross;
using geometry::dot;
using geometry::minus;

/// True when no tetrahedron of some of the points has a volume to speak of.
bool is_flat(const std::vector<Vec3>& points) {
  const Vec3& origin = points[0];
  const auto farthest = [&](auto measure) {
    Vec3 best = origin;
    double most = 0;
    for (const Vec3& p : points)
      if (const double m = measure(minus(p, origin)); m > most) most = m, best = p;
    return minus(best, origin);
  };
  const Vec3 u = farthest([](const Vec3& p) { return dot(p, p); });
  const Vec3 v = farthest([&](const Vec3& p) { return dot(cross(u, p), cross(u, p)); });
  const Vec3 n = cross(u, v);
  const Vec3 w = farthest([&](const Vec3& p) { return std::abs(dot(n, p)); });
  const double length = std::sqrt(dot(u, u));
  return !(std::abs(dot(n, w)) > 1e-6 * length * length * length);
}

MeshShape read_mesh_data(Fields& fields) {
  MeshShape mesh;
  for (const Node& vertex : fields.require("vertices").list(3, max_count))
    mesh.vertices.push_back(vertex.vec3(any_place));
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  for (const Node& triangle : fields.require("triangles").list(1, max_count)) {
    const std::vector<Node> corners = triangle.list(3, 3);
    std::array<std::uint32_t, 3> t{};
    for (std::size_t i = 0; i < 3; ++i) t[i] = static_cast<std::uint32_t>(corners[i].integer(0, last));
    const Vec3 u = minus(mesh.vertices[t[1]], mesh.vertices[t[0]]), v = minus(mesh.vertices[t[2]], mesh.vertices[t[0]]);
    if (!(dot(cross(u, v), cross(u, v)) > 1e-18)) triangle.fail("a triangle without area");
    mesh.triangles.push_back(t);
  }
  return mesh;
}

}  // namespace

void read(Fields& fields, MeshShape& mesh) {
  const auto file = fields.find("file");
  if (!file || is_foreign_mesh(*file)) {
    mesh = file ? import_mesh(fields, *file) : read_mesh_data(fields);
    return;
  }
  const std::string name = file_beside(*file);
  const nlohmann::json document = parse_json(read_text_file(name), name);
  Fields data(Node(document, "", name));
  mesh = read_mesh_data(data);
  data.finish();
}

namespace {

/// Smooth hills: three octaves of crossed sine waves with phases drawn from the seed, at most `amplitude` high or deep.
void raise_hills(HeightfieldShape& field, double amplitude, double wavelength, std::uint64_t seed) {
  Random random(seed);
  constexpr int octaves = 3;
  double phase[octaves][4];
  for (auto& row : phase)
    for (double& p : row) p = random.range(0, 2 * std::numbers::pi);
  const double whole = 2 - std::ldexp(1.0, 1 - octaves);  // 1 + 1/2 + 1/4
  field.heights.reserve(static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows));
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      double height = 0;
      for (int o = 0; o < octaves; ++o) {
        const double k = 2 * std::numbers::pi / wavelength * (1 << o) * field.cell;
        height += std::ldexp(std::sin(k * column + phase[o][0] + std::sin(0.7 * k * row + phase[o][1])) *
                                 std::sin(k * row + phase[o][2] + std::sin(0.7 * k * column + phase[o][3])),
                             -o);
      }
      field.heights.push_back(static_cast<float>(amplitude * height / whole));
    }
  }
}

void read_heights(Fields& fields, HeightfieldShape& field) {
  field.columns = fields.require("columns").integer(2, 2049);
  field.rows = fields.require("rows").integer(2, 2049);
  field.cell = fields.number("cell", any_size);
  const auto heights = fields.find("heights");
  const auto hills = fields.find("hills");
  if (heights && hills) hills->fail("give \"heights\" or \"hills\", not both");
  if (heights) {
    const auto size = static_cast<std::size_t>(field.columns) * static_cast<std::size_t>(field.rows);
    for (const Node& height : heights->list(size, size))
      field.heights.push_back(static_cast<float>(height.number(any_place)));
  } else if (hills) {
    Fields shape(*hills);
    const double amplitude = shape.number("amplitude", {0, max_length});
    const double wavelength = shape.number("wavelength", any_size);
    raise_hills(field, amplitude, wavelength, shape.require("seed").count());
    shape.finish();
  } else {
    fields.node().fail("a height field needs \"heights\" or \"hills\"");
  }
}

/// Two triangles to a cell, centred on the origin in x and z.
MeshShape mesh_of(const HeightfieldShape& field) {
  MeshShape mesh;
  const auto columns = static_cast<std::uint32_t>(field.columns), rows = static_cast<std::uint32_t>(field.rows);
  for (std::uint32_t row = 0; row < rows; ++row)
    for (std::uint32_t column = 0; column < columns; ++column)
      mesh.vertices.push_back({(column - 0.5 * (columns - 1)) * field.cell,
                               static_cast<double>(field.heights[mesh.vertices.size()]),
                               (row - 0.5 * (rows - 1)) * field.cell});
  for (std::uint32_t row = 0; row + 1 < rows; ++row) {
    for (std::uint32_t column = 0; column + 1 < columns; ++column) {
      const std::uint32_t a = row * columns + column;
      mesh.triangles.push_back({a, a + columns, a + 1});
      mesh.triangles.push_back({a + 1, a + columns, a + columns + 1});
    }
  }
  return mesh;
}

struct ReadShape {
  Fields& fields;
  Scene& scene;
  const Names& names;

  void operator()(HullShape& hull) const {
    if (const auto file = fields.find("file")) {
      hull = import_hull(fields, *file);
      return;
    }
    const Node node = fields.require("points");
    for (const Node& point : node.list(4, 1000)) hull.points.push_back(point.vec3(any_place));
    if (is_flat(hull.points)) node.fail("all points lie in one plane");
  }
  void operator()(PlaneShape& plane) const {
    plane.normal = read_direction(fields.require("normal"));
    plane.offset = fields.number("offset", 0, any_place);
  }
  void operator()(HeightfieldShape& field) const { read_heights(fields, field); }
  void operator()(MeshShape& mesh) const {
    if (const auto node = fields.find("heightfield")) {
      Fields heights(*node);
      HeightfieldShape field;
      read_heights(heights, field);
      mesh = mesh_of(field);
      heights.finish();
    } else {
      read(fields, mesh);
    }
    mesh.internal_edges = fields.boolean("internal_edges", mesh.internal_edges);
  }
  void operator()(CompoundShape& compound) const {
    if (const auto file = fields.find("file")) {
      compound = import_compound(fields, *file, scene);
      return;
    }
    for (const Node& item : fields.require("children").list(1, 1000)) {
      Fields child(item);
      const Node shape = child.require("shape");
      CompoundChild part;
      part.shape = look_up(names.shapes, shape, "shape before this one");
      if (use_of(scene.shapes[part.shape].value) != ShapeUse::part) shape.fail("parts of a compound are convex");
      part.position = child.vec3("position", Vec3{}, any_place);
      part.rotation = read_rotation(child);
      child.finish();
      compound.children.push_back(part);
    }
  }
  template <class Plain>
  void operator()(Plain& shape) const {
    read(fields, shape);
  }
};

/// How large the least extent along the axes is, of shapes that may be rounded; 0 of others.
double least_extent(const ShapeValue& shape) {
  return std::visit(
      []<class S>(const S& s) {
        if constexpr (std::is_same_v<S, BoxShape>) {
          return 2 * std::min({s.half_extents[0], s.half_extents[1], s.half_extents[2]});
        } else if constexpr (std::is_same_v<S, CylinderShape> || std::is_same_v<S, ConeShape>) {
          return std::min(2 * s.radius, s.height);
        } else if constexpr (std::is_same_v<S, HullShape>) {
          Vec3 low = s.points[0], high = low;
          for (const Vec3& p : s.points)
            for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
          const Vec3 size = minus(high, low);
          return std::min({size[0], size[1], size[2]});
        } else {
          return 0.0;
        }
      },
      shape);
}

void read_margin(Fields& fields, Shape& shape) {
  const double extent = least_extent(shape.value);
  const auto node = extent > 0 ? fields.find("margin") : std::nullopt;
  if (!node) return;
  shape.margin = node->number({0, max_length});
  if (*shape.margin > extent / 8) node->fail("must be at most an eighth of the shape's least extent");
}

}  // namespace

void load_shapes(const Node& node, Scene& scene, Names& names) {
  for (const Node& item : node.list(0, 10'000)) {
    Fields fields(item);
    const Node name = fields.require("name");
    Shape shape{name.text(), {}, {}};
    read_kind(fields, shape.value, ReadShape{fields, scene, names});
    read_margin(fields, shape);
    fields.finish();
    if (!names.shapes.emplace(shape.name, scene.shapes.size()).second)
      name.fail("a second shape called \"" + shape.name + "\"");
    scene.shapes.push_back(std::move(shape));
  }
}

}  // namespace boxstream::scenes
