// SPDX-License-Identifier: MIT
#include <stdexcept>

#include "import/mesh_reader.hpp"

namespace boxstream::imports {

RawMesh read_raw_mesh(const std::string&, UpAxis) {
  throw std::runtime_error("this build has no assimp, so it reads no meshes but those of scenes (.json)");
}

}  // namespace boxstream::imports
