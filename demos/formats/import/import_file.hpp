// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/import/convex_parts.hpp"
#include "formats/import/fragment.hpp"
#include "formats/scene_model/joints.hpp"
#include "formats/scene_model/values.hpp"

namespace boxstream::imports {

/// Where imported bodies are put, and what files do not say.
struct ImportOptions {
  scenes::Vec3 position{};
  scenes::Quat rotation{0, 0, 0, 1};
  std::optional<bool> z_up;       // none: as is usual for the kind of file: URDF yes, others no
  bool fixed_base = false;        // URDF: the root link does not move
  std::optional<double> density;  // kg/m^3, of links without a mass and of meshes; none: an error, and water for meshes
  std::optional<PartsOptions> parts;  // URDF: cut meshes into convex parts; none: their convex hulls
  std::vector<std::string> packages;  // URDF: folders that package:// may mean, or that hold those
  std::string within;  // URDF: the folder that meshes lie in or below, symbolic links followed; empty: anywhere
  bool hold = false;   // URDF: motors that keep joints where they are, as strong as <limit effort> if any
  std::map<std::string, scenes::Motor> motors;  // URDF: by name of joint
  bool keep_still = false;                      // mesh: a static triangle mesh in place of a body of convex parts
  scenes::Vec3 scale{1, 1, 1};                  // mesh: m for each unit of the file, by axis
};

/// Whether `path` is named like a file that import_file reads: .urdf, .bullet, or a mesh.
bool is_importable(const std::string& path);

/// A file as blocks of a scene of format 1: the text of a JSON object with "shapes", "materials", "bodies", "joints",
/// "exclusions" and, where the file says so, "gravity", and with "notes", one line for each thing of the file that
/// scenes have no word for. The text is not a scene, and not checked as one: its reader does that.
///
/// Throws scenes::SceneError "PATH: reason" for what cannot be read or carried over.
std::string import_file(const std::string& path, const ImportOptions& options);

// The reader of each kind of file. The first two run in a child process (guarded.hpp) and throw any std::exception
// with the reason; a kind whose library was not there at build time has one that says so.

void read_urdf(const std::string& path, const ImportOptions& options, Fragment& out);
void read_bullet(const std::string& path, Fragment& out);

/// The only one that is called outside: it guards the reading itself, and what it throws names the file.
void add_mesh_body(const std::string& path, const ImportOptions& options, Fragment& out);

}  // namespace boxstream::imports
