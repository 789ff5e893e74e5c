// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

#include <cmath>
#include <stdexcept>

#include "formats/geometry/convex_hull.hpp"
#include "formats/import/convex_parts.hpp"
#include "formats/import/import_file.hpp"
#include "formats/import/mesh.hpp"
#include "formats/scene_json/json_text.hpp"
#include "formats/scene_model/scene_error.hpp"

namespace boxstream::scenes {
namespace {

/// One factor for all axes, or one for each; negative ones mirror.
Vec3 read_scale(Fields& fields) {
  const auto node = fields.find("scale");
  if (!node) return {1, 1, 1};
  const Range any_factor{-1e4, 1e4};
  Vec3 scale{};
  if (node->json().is_array())
    scale = node->vec3(any_factor);
  else
    scale.fill(node->number(any_factor));
  for (const double factor : scale)
    if (factor == 0) node->fail("must not be 0");
  return scale;
}

imports::TriangleMesh read_file(Fields& fields, const Node& file) {
  if (!is_foreign_mesh(file))
    file.fail("not a mesh of a kind that is known (.obj, .stl, .ply, .off, .dae, .gltf, .glb)");
  return imports::read_mesh(file_beside(file), read_scale(fields));
}

imports::PartsOptions read_parts(const Node& node) {
  imports::PartsOptions options;
  Fields fields(node);
  options.max_hulls =
      static_cast<std::size_t>(fields.integer("max_hulls", static_cast<int>(options.max_hulls), 1, 256));
  options.max_error = fields.number("max_error", options.max_error, {0, 100});
  fields.finish();
  return options;
}

std::map<std::string, Motor> read_motors(const Node& node) {
  std::map<std::string, Motor> motors;
  Fields block(node);
  for (const auto& [name, value] : node.json().items()) {
    Fields fields(block.require(name));
    const double speed = fields.number("speed", any_velocity);
    motors[name] = {speed, fields.number("max_force", any_force)};
    fields.finish();
  }
  return motors;
}

/// Whether the world has another gravity than the file, which has floats.
bool is_other_gravity(const WorldSettings& world, const Vec3& gravity) {
  constexpr double rounding = 1e-4;
  return world.tumbling || std::abs(world.gravity[0] - gravity[0]) > rounding ||
         std::abs(world.gravity[1] - gravity[1]) > rounding || std::abs(world.gravity[2] - gravity[2]) > rounding;
}

Scene load_blocks(const nlohmann::json& document, const std::string& file) try {
  Fields blocks(Node(document, "", file));
  Scene part;
  Names inside;
  load_materials(blocks.require("materials"), inside);
  load_shapes(blocks.require("shapes"), part, inside);
  load_bodies(blocks.require("bodies"), part, inside);
  load_joints(blocks.require("joints"), part, inside);
  load_exclusions(blocks.require("exclusions"), part, inside);
  return part;
} catch (const SceneError& error) {
  throw SceneError(with_name(error.what(), file, document));
}

}  // namespace

bool is_foreign_mesh(const Node& file) {
  return imports::is_mesh_file(file.text());
}

MeshShape import_mesh(Fields& fields, const Node& file) {
  imports::TriangleMesh mesh = read_file(fields, file);
  return {std::move(mesh.vertices), std::move(mesh.triangles), false};
}

HullShape import_hull(Fields& fields, const Node& file) {
  auto hull = geometry::convex_hull(read_file(fields, file).vertices);
  if (!hull) file.fail("all points lie in one plane");
  return {std::move(hull->points)};
}

CompoundShape import_compound(Fields& fields, const Node& file, Scene& scene) try {
  const imports::TriangleMesh mesh = read_file(fields, file);
  const auto options = fields.find("decompose");
  CompoundShape compound;
  for (geometry::Hull& hull :
       imports::convex_parts(mesh, options ? read_parts(*options) : imports::PartsOptions{}).hulls) {
    compound.children.push_back({scene.shapes.size(), {}, {0, 0, 0, 1}});
    scene.shapes.push_back({"", HullShape{std::move(hull.points)}, {}});
  }
  return compound;
} catch (const SceneError&) {
  throw;
} catch (const std::runtime_error& error) {
  file.fail(error.what());
}

void read_import(Fields& fields, const Scene& scene, const Names& names, ImportGenerator& generator) {
  const Node file = fields.require("file");
  generator.file = file_beside(file);
  imports::ImportOptions options;
  options.within = folder_of(file);
  // Its bodies lie around that, and must be at places too.
  options.position = fields.vec3("position", options.position, {-max_length / 2, max_length / 2});
  options.rotation = read_rotation(fields);
  if (const auto up = fields.find("up")) options.z_up = up->choice({"y", "z"}) == 1;
  options.fixed_base = fields.boolean("fixed_base", false);
  options.keep_still = fields.boolean("static", false);
  options.scale = read_scale(fields);
  options.hold = fields.boolean("hold", false);
  if (const auto density = fields.find("density")) options.density = density->number(positive(1e5));
  if (const auto parts = fields.find("decompose")) options.parts = read_parts(*parts);
  if (const auto motors = fields.find("motors")) options.motors = read_motors(*motors);
  if (const auto packages = fields.find("packages"))
    for (const Node& folder : packages->list(0, 100)) options.packages.push_back(folder_beside(folder));

  const nlohmann::json document = parse_json(imports::import_file(generator.file, options), generator.file);
  Scene part = load_blocks(document, generator.file);
  generator.shapes = std::move(part.shapes);
  generator.bodies = std::move(part.bodies);
  generator.joints = std::move(part.joints);
  generator.exclusions = std::move(part.exclusions);
  generator.notes = document["notes"].get<std::vector<std::string>>();
  if (document.contains("gravity") && is_other_gravity(scene.world, document["gravity"].get<Vec3>()))
    generator.notes.push_back("gravity of the file: left out");
  if (fields.find("material")) {
    const Material material = read_material(fields, names);
    for (Body& body : generator.bodies) body.traits.material = material;
  }
}

}  // namespace boxstream::scenes
