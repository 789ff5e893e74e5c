// SPDX-License-Identifier: MIT
#include "boxstream/mesh/surface.hpp"

#include "boxstream/shared/print.hpp"
#include "formats/import/mesh_reader.hpp"

namespace boxstream::tool {

imports::TriangleMesh surface_in(const std::string& path, StatusLine& status) {
  status.say("reading " + path);
  imports::TriangleMesh mesh = imports::read_surface(path);
  if (const std::string note = imports::surface_note(path); !note.empty()) {
    status.clear();
    remark("note: " + path + ": " + note);
  }
  return mesh;
}

}  // namespace boxstream::tool
