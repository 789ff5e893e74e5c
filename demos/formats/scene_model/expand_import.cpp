// SPDX-License-Identifier: MIT
#include "formats/scene_model/expand_parts.hpp"

namespace boxstream::scenes {

void ImportGenerator::generate(Random&, Expanded& out) const {
  const std::size_t first_shape = out.shapes.size(), first_body = out.bodies.size();
  for (Shape shape : shapes) {
    if (auto* const compound = std::get_if<CompoundShape>(&shape.value))
      for (CompoundChild& child : compound->children) child.shape += first_shape;
    out.shapes.push_back(std::move(shape));
  }
  for (Body body : bodies) {
    body.traits.shape += first_shape;
    out.bodies.push_back(std::move(body));
  }
  for (Joint joint : joints) {
    joint.a += first_body;
    if (joint.b) *joint.b += first_body;
    out.joints.push_back(joint);
  }
  for (const auto& [a, b] : exclusions) out.exclusions.push_back({a + first_body, b + first_body});
}

}  // namespace boxstream::scenes
