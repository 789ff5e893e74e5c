// SPDX-License-Identifier: MIT
#include "formats/scene_json/load_parts.hpp"

namespace boxstream::scenes {

void load_expect(const Node& node, Scene& scene) {
  Fields fields(node);
  Expect& e = scene.expect;
  const auto count = [&](const char* key, std::optional<std::uint64_t>& value) {
    if (const auto found = fields.find(key)) value = found->count();
  };
  count("objects", e.objects);
  count("bodies", e.bodies);
  count("static", e.fixed);
  count("kinematic", e.kinematic);
  count("dynamic", e.dynamic);
  count("joints", e.joints);
  count("sensors", e.sensors);
  count("characters", e.characters);
  count("soft_bodies", e.soft_bodies);
  count("soft_nodes", e.soft_nodes);
  count("boxes", e.boxes);
  count("spheres", e.spheres);
  count("capsules", e.capsules);
  count("cylinders", e.cylinders);
  count("cones", e.cones);
  count("hulls", e.hulls);
  count("planes", e.planes);
  count("heightfields", e.heightfields);
  count("meshes", e.meshes);
  count("compounds", e.compounds);
  if (const auto ratio = fields.find("size_ratio")) e.size_ratio = ratio->number({1, 1e6});
  fields.finish();
}

}  // namespace boxstream::scenes
