// SPDX-License-Identifier: MIT
#include "formats/import/import_file.hpp"

#include <cmath>
#include <numbers>

#include "formats/import/file_kind.hpp"
#include "formats/import/fragment.hpp"
#include "formats/import/geometry.hpp"
#include "formats/import/guarded.hpp"
#include "formats/import/mesh.hpp"

namespace boxstream::imports {
namespace {

Frame place_of(const ImportOptions& options, bool usually_z_up) {
  const Frame place{options.position, options.rotation};
  if (!options.z_up.value_or(usually_z_up)) return place;
  const double half = std::numbers::sqrt2 / 2;
  return place.place(Frame{{}, {-half, 0, 0, half}});
}

}  // namespace

bool is_importable(const std::string& path) {
  const std::string kind = file_kind(path);
  return kind == "urdf" || kind == "bullet" || is_mesh_file(path);
}

std::string import_file(const std::string& path, const ImportOptions& options) {
  check_is_file(path);
  const std::string kind = file_kind(path);
  if (!is_importable(path))
    fail(path, "not a kind of file that is imported (.urdf, .bullet, .obj, .stl, .ply, .off, .dae, .gltf, .glb)");
  if (!is_mesh_file(path) && options.scale != scenes::Vec3{1, 1, 1})
    fail(path, "only meshes have a scale: the file is in metres");
  Fragment fragment(place_of(options, kind == "urdf"));
  if (is_mesh_file(path)) {
    add_mesh_body(path, options, fragment);
    return fragment.text();
  }
  return guarded(
      path,
      [&] {
        if (kind == "urdf")
          read_urdf(path, options, fragment);
        else
          read_bullet(path, fragment);
        return fragment.text();
      },
      allowance_for(path));
}

}  // namespace boxstream::imports
