// SPDX-License-Identifier: MIT
#include "boxstream/mesh/surface.hpp"

#include "boxstream/shared/print.hpp"
#include "formats/import/rounding.hpp"

namespace boxstream::tool {

imports::TriangleMesh surface_in(const std::string& path, StatusLine& status) {
  status.say("reading " + path);
  imports::TriangleMesh mesh = imports::read_surface(path);
  if (const std::string rounding = imports::rounding_note(path); !rounding.empty()) {
    status.clear();
    remark("note: " + path + ": " + rounding);
  }
  return mesh;
}

}  // namespace boxstream::tool
