// SPDX-License-Identifier: MIT
#include "log_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "machine.hpp"
#include "record/recorder.hpp"

namespace boxstream::tool {
namespace {

record::Header header_of(const scenes::Scene& scene, const std::string& broadphase) {
  record::Header header;
  header.scalar = record::bullet_scalar;
  for (std::size_t d = 0; d < 3; ++d) {
    header.bounds.min[d] = scene.world.bounds.min[d];
    header.bounds.max[d] = scene.world.bounds.max[d];
  }
  header.about = fmt::format("{} on {} (boxstream {}, Bullet {})", scene.meta.name, broadphase, boxstream_version(),
                             bullet_version());
  return header;
}

}  // namespace

LogFile::LogFile(const std::string& path, const scenes::Scene& scene, const std::string& broadphase)
    : path_(path),
      file_(path),
      stream_(file_.path_to_write(), std::ios::binary),
      writer_(stream_, header_of(scene, broadphase)) {}

scenes::Simulation::Wrap LogFile::wrap() {
  return [this](std::unique_ptr<btBroadphaseInterface> broadphase) {
    return std::make_unique<record::Recorder>(std::move(broadphase), writer_);
  };
}

void LogFile::finish() {
  writer_.finish();
  stream_.close();
  if (!stream_) throw std::runtime_error(path_ + ": cannot be written");
}

}  // namespace boxstream::tool
