// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "boxstream/shared/print.hpp"
#include "formats/import/mesh.hpp"

namespace boxstream::tool {

/// The surface in a file; a line on standard error says where its coordinates become floats.
imports::TriangleMesh surface_in(const std::string& path, StatusLine& status);

}  // namespace boxstream::tool
