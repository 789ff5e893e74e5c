// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "formats/import/import_file.hpp"
#include "formats/import/mesh_reader.hpp"

// In place of readers whose library was not found.
namespace boxstream::imports {

#ifndef BOXSTREAM_HAS_BULLET_IMPORTER
void read_bullet(const std::string&, Fragment&) {
  throw std::runtime_error("this build has no importer of Bullet (libbullet-extras), so it reads no .bullet files");
}
#endif

#ifndef BOXSTREAM_HAS_ASSIMP
RawMesh read_by_assimp(const std::string&, UpAxis) {
  throw std::runtime_error("this build has no assimp, so it reads no meshes but .obj, .ply, .stl and .off");
}
#endif

#ifndef BOXSTREAM_HAS_URDFDOM
void read_urdf(const std::string&, const ImportOptions&, Fragment&) {
  throw std::runtime_error("this build has no urdfdom, so it reads no URDF");
}
#endif

}  // namespace boxstream::imports
