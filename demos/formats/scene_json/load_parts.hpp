// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "formats/scene_json/json_node.hpp"
#include "formats/scene_model/scene.hpp"

/// What scenes name: looked up beside the scene, and in its folder or below it, wherever `..`, absolute names and
/// symbolic links lead. Scenes of others may name any file of the machine.
namespace boxstream::scenes {

/// Of the scene that the node is in.
std::string folder_of(const Node& node);

/// The file, or the folder, that is there. Throw SceneError.
std::string file_beside(const Node& file);
std::string folder_beside(const Node& folder);

}  // namespace boxstream::scenes

/// The parts of the loader; each fills one block of the scene and throws SceneError.
namespace boxstream::scenes {

/// Limits that keep every number well inside float, squared or cubed: metres, metres per second, kilograms, newtons.
inline constexpr double max_length = 1e5;
inline constexpr double max_speed = 1e4;
inline constexpr double max_mass = 1e9;
inline constexpr double max_inertia = 1e15;
inline constexpr double max_force = 1e9;
inline constexpr int max_count = 1'000'000;

inline constexpr Range any_place{-max_length, max_length};
inline constexpr Range any_velocity{-max_speed, max_speed};
inline constexpr Range any_force{0, max_force};
inline const Range any_size = positive(max_length);

using MaterialNames = std::map<std::string, Material>;

/// What bodies refer to by name.
struct Names {
  std::map<std::string, std::size_t> shapes;
  MaterialNames materials;
  std::map<std::string, std::size_t> bodies;
};

/// The thing called as `node` says, or an error that names it.
template <class T>
const T& look_up(const std::map<std::string, T>& things, const Node& node, const char* what) {
  const std::string name = node.text();
  const auto found = things.find(name);
  if (found == things.end()) node.fail(std::string("no ") + what + " called \"" + name + "\"");
  return found->second;
}

/// "rotation": {"axis": [x, y, z], "degrees": angle}; identity if absent.
Quat read_rotation(Fields& fields);
/// A direction as a unit vector.
Vec3 read_direction(const Node& node);

/// {"min": [x, y, z], "max": [x, y, z]}, not flat on any axis.
Bounds read_bounds(const Node& node);

void load_time(const Node& node, Scene& scene);
void load_world(const Node& node, Scene& scene);
void load_solver(const Node& node, Scene& scene);
void load_broadphase(const Node& node, Scene& scene);

/// The "material" that a body names, or the default one.
Material read_material(Fields& fields, const Names& names);
void load_materials(const Node& node, Names& names);

inline void read(Fields& fields, BoxShape& box) {
  box.half_extents = fields.require("half_extents").vec3(any_size);
}
inline void read(Fields& fields, SphereShape& sphere) {
  sphere.radius = fields.number("radius", any_size);
}
/// A capsule, a cylinder or a cone.
template <class Round>
void read(Fields& fields, Round& round) {
  round.radius = fields.number("radius", any_size);
  round.height = fields.number("height", any_size);
}
/// A mesh, given in place or in a file beside the scene's.
void read(Fields& fields, MeshShape& mesh);
void load_shapes(const Node& node, Scene& scene, Names& names);

BodyTraits read_traits(Fields& fields, const Scene& scene, const Names& names, bool may_be_fixed);
void load_bodies(const Node& node, Scene& scene, Names& names);
void load_generators(const Node& node, Scene& scene, const Names& names);
void load_joints(const Node& node, Scene& scene, const Names& names);
void load_exclusions(const Node& node, Scene& scene, const Names& names);
void load_sensors(const Node& node, Scene& scene);
void load_characters(const Node& node, Scene& scene);
void load_vehicles(const Node& node, Scene& scene, const Names& names);
void load_soft_bodies(const Node& node, Scene& scene);
void load_fields(const Node& node, Scene& scene);
void load_queries(const Node& node, Scene& scene, const Names& names);

void load_effects(const Node& node, Scene& scene);
void load_checks(const Node& node, Scene& scene);
void load_outputs(const Node& node, Scene& scene);
void load_expect(const Node& node, Scene& scene);

}  // namespace boxstream::scenes

/// Reading files of other programs that scenes refer to. All throw SceneError.
namespace boxstream::scenes {

/// Whether it is named like a mesh of another program, rather than a mesh in JSON.
bool is_foreign_mesh(const Node& file);

MeshShape import_mesh(Fields& fields, const Node& file);
HullShape import_hull(Fields& fields, const Node& file);
/// Its convex parts become shapes of the scene, without names.
CompoundShape import_compound(Fields& fields, const Node& file, Scene& scene);

/// `scene` has its world already.
void read_import(Fields& fields, const Scene& scene, const Names& names, ImportGenerator& generator);

}  // namespace boxstream::scenes
