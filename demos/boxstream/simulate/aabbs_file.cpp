// SPDX-License-Identifier: MIT
#include "boxstream/simulate/aabbs_file.hpp"

#include <btBulletCollisionCommon.h>
#include <fmt/format.h>

#include <limits>

#include "boxstream/shared/bad_input.hpp"

namespace boxstream::tool {
namespace {

void collect_boxes(const scenes::Simulation& simulation, std::vector<Aabb>& boxes) {
  constexpr float far = std::numeric_limits<float>::max();
  constexpr Aabb nowhere{{far, far, far}, {-far, -far, -far}};
  boxes.clear();
  for (const btCollisionObject* const object : simulation.objects()) {
    boxes.push_back(nowhere);
    const btBroadphaseProxy* const proxy = object->getBroadphaseHandle();
    if (proxy == nullptr) continue;
    for (int d = 0; d < 3; ++d) {
      boxes.back().min[d] = static_cast<float>(proxy->m_aabbMin[d]);
      boxes.back().max[d] = static_cast<float>(proxy->m_aabbMax[d]);
    }
  }
}

}  // namespace

AabbsFile::AabbsFile(const std::string& path) : file_(path) {}

void AabbsFile::begin(const scenes::Simulation& simulation, std::uint64_t steps) {
  const scenes::Scene& scene = simulation.scene();
  if (simulation.objects().empty() || steps > aabbs::most)
    throw BadInput(
        fmt::format("{}: such a file has at least one object, and at most {} steps", file_.name(), aabbs::most));
  aabbs::Header header;
  header.scene = scene.meta.name;
  header.type = fmt::format("{}", fmt::join(scene.meta.tags, ", "));
  header.objects = static_cast<std::uint32_t>(simulation.objects().size());
  header.steps = static_cast<std::uint32_t>(steps);
  for (std::size_t d = 0; d < 3; ++d) {
    header.world.min[d] = static_cast<float>(scene.world.bounds.min[d]);
    header.world.max[d] = static_cast<float>(scene.world.bounds.max[d]);
  }
  writer_.emplace(file_.stream(), std::move(header));
  collect_boxes(simulation, boxes_);
  writer_->frame(boxes_);
}

void AabbsFile::after_pairs(const scenes::Simulation& simulation) {
  collect_boxes(simulation, boxes_);
}

void AabbsFile::after_step(const scenes::Simulation&) {
  writer_->frame(boxes_);
}

void AabbsFile::finish() {
  // If something could not be written, commit gives the reason.
  if (file_.stream().flush()) writer_->finish();
}

}  // namespace boxstream::tool
