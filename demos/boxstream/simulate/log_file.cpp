// SPDX-License-Identifier: MIT
#include "boxstream/simulate/log_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "boxstream/shared/machine.hpp"
#include "formats/record/recorder.hpp"

namespace boxstream::tool {
namespace {

record::Header header_of(const scenes::Scene& scene, const std::string& broadphase) {
  record::Header header;
  header.scalar = record::bullet_scalar;
  for (std::size_t d = 0; d < 3; ++d) {
    header.bounds.min[d] = scene.world.bounds.min[d];
    header.bounds.max[d] = scene.world.bounds.max[d];
  }
  header.about = fmt::format("{} on {} (boxstream {}, Bullet {})", scene.meta.name, broadphase,
                             measure::library_version(), bullet_version());
  return header;
}

}  // namespace

LogFile::LogFile(const std::string& path, const scenes::Scene& scene, const std::string& broadphase)
    : file_(path), writer_(file_.stream(), header_of(scene, broadphase)) {}

scenes::Simulation::Wrap LogFile::wrap() {
  return [this](std::unique_ptr<btBroadphaseInterface> broadphase) {
    return std::make_unique<record::Recorder>(std::move(broadphase), writer_);
  };
}

void LogFile::finish() {
  writer_.finish();
}

}  // namespace boxstream::tool
