// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {

void load_materials(const Node& node, Names& names) {
  constexpr Range any_friction{0, 100};
  Fields block(node);
  for (const auto& [name, value] : node.json().items()) {
    const Node item = block.require(name);
    if (name.empty()) item.fail("a material needs a name");
    Fields fields(item);
    Material material;
    material.friction = fields.number("friction", material.friction, any_friction);
    material.rolling = fields.number("rolling", material.rolling, any_friction);
    material.spinning = fields.number("spinning", material.spinning, any_friction);
    material.restitution = fields.number("restitution", material.restitution, {0, 1});
    material.anisotropic = fields.vec3("anisotropic", material.anisotropic, any_friction);
    fields.finish();
    names.materials.emplace(name, material);
  }
}

Material read_material(Fields& fields, const Names& names) {
  const auto node = fields.find("material");
  return node ? look_up(names.materials, *node, "material") : Material{};
}

}  // namespace boxstream::scenes
