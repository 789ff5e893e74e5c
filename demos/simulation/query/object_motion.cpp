// SPDX-License-Identifier: MIT
#include "simulation/query/object_motion.hpp"

#include <cstdlib>

#include "simulation/query/courses.hpp"

namespace boxstream::query {

ObjectMotion::ObjectMotion(const QueryScene& scene) : shapes_(scene.shapes) {
  for (std::size_t group = 0; group < scene.groups.size(); ++group) {
    groups_.push_back(scene.groups[group].name);
    std::uint32_t bodies = 0;
    for (const Actor& described : scene.groups[group].actors) {
      // Each has a stream of its own, so that a change of one leaves the others alone.
      scenes::Random random(scene.seed + 0x9e3779b97f4a7c15U * (courses_.size() + 1));
      auto actor = std::visit([&](const auto& what) { return make_course(what, shapes_, random); }, described);
      std::uint32_t last = 0;
      const std::size_t first = objects_.size();
      for (const Part& part : actor->parts()) {
        objects_.push_back({part.shape, group, bodies + part.body, part.link, part.span, actor->moves(), part.name});
        last = std::max(last, part.body + 1);
      }
      bodies += last;
      poses_.resize(objects_.size());
      if (actor->parts().empty()) continue;
      actor->place(0, &poses_[first]);
      courses_.push_back({first, std::move(actor)});
    }
  }
}

ObjectMotion::~ObjectMotion() = default;

void ObjectMotion::go_to(std::uint64_t step) {
  for (const Placed& each : courses_)
    if (each.course->moves()) each.course->place(step, &poses_[each.first]);
}

std::string ObjectMotion::name(std::size_t object) const {
  const Object& o = objects_[object];
  std::string text = groups_[o.group] + " body " + std::to_string(o.body);
  if (o.part[0] != '\0') text += std::string(" ") + o.part + " " + std::to_string(o.link);
  return text;
}

bool belong_together(const Object& a, const Object& b) {
  return a.group == b.group && a.body == b.body && std::abs(a.link - b.link) <= std::max(a.span, b.span);
}

}  // namespace boxstream::query
