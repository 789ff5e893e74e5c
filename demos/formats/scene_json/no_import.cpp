// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {
namespace {

[[noreturn]] void fail(const Node& file) {
  file.fail("this boxstream was built without the readers of other programs' files (./dev build has them)");
}

}  // namespace

bool is_foreign_mesh(const Node& file) {
  return !file.text().ends_with(".json");
}

MeshShape import_mesh(Fields&, const Node& file) {
  fail(file);
}

HullShape import_hull(Fields&, const Node& file) {
  fail(file);
}

CompoundShape import_compound(Fields&, const Node& file, Scene&) {
  fail(file);
}

void read_import(Fields& fields, const Scene&, const Names&, ImportGenerator&) {
  fail(fields.require("file"));
}

}  // namespace boxstream::scenes
