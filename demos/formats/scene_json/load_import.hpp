// SPDX-License-Identifier: MIT
#pragma once

#include "formats/scene_json/load_parts.hpp"

/// Reading files of other programs that scenes refer to. All throw SceneError.
namespace boxstream::scenes {

/// Whether it is named like a mesh of another program, rather than a mesh in JSON.
bool is_foreign_mesh(const Node& file);

MeshShape import_mesh(Fields& fields, const Node& file);
HullShape import_hull(Fields& fields, const Node& file);
/// Its convex parts become shapes of the scene, without names.
CompoundShape import_compound(Fields& fields, const Node& file, Scene& scene);

void read_import(Fields& fields, const Names& names, ImportGenerator& generator);

}  // namespace boxstream::scenes
