// SPDX-License-Identifier: MIT
#include "boxstream/simulate/step_files.hpp"

#include <btBulletCollisionCommon.h>
#include <btBulletDynamicsCommon.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "boxstream/shared/bad_input.hpp"
#include "boxstream/shared/report.hpp"
#include "formats/record/recorder.hpp"
#include "formats/scene_model/expand.hpp"

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

/// As a field of CSV: in quotes, and those in it twice.
std::string in_quotes(const std::string& text) {
  std::string field = "\"";
  for (const char c : text) field += c == '"' ? "\"\"" : std::string(1, c);
  return field + "\"";
}

}  // namespace

void CsvFile::after_step(const scenes::Simulation& simulation) {
  auto& row = rows_.emplace_back();
  for (std::size_t i = 0; i < metrics.size(); ++i) row[i] = simulation.metric(metrics[i]);
}

void CsvFile::write(const RunResult& result) {
  std::string text =
      "step,bodies,pairs,begun,ended,ghost_overlaps,update_aabbs_ms,overlapping_pairs_ms,dispatch_ms,solve_ms,step_ms,"
      "state_hash";
  for (const Metric metric : metrics) text += fmt::format(",{}", name_of(metric));
  text += "\n";
  const auto to = std::back_inserter(text);
  const std::vector<scenes::StepResult>& steps = result.worlds.front().steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const scenes::StepResult& s = steps[i];
    fmt::format_to(to, "{},{},{},{},{},{},{},{},{},{},{},{:016x}", s.step, s.bodies, s.pairs, s.begun, s.ended,
                   s.ghost_overlaps, s.update_aabbs_ms, s.overlapping_pairs_ms, s.dispatch_ms, s.solve_ms, s.step_ms,
                   s.state_hash);
    for (const double value : rows_[i]) fmt::format_to(to, ",{}", value);
    text += "\n";
  }
  file_.stream() << text;
}

StatesFile::StatesFile(const std::string& path) : file_(path) {
  file_.stream() << "step,seconds,object,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz\n";
}

void StatesFile::write(const scenes::Simulation& simulation) {
  const std::uint64_t step = simulation.steps_done();
  std::string text;
  const auto to = std::back_inserter(text);
  // Bodies come first among the objects. One that is frozen is static to Bullet, and keeps its lines.
  const std::vector<scenes::Body>& bodies = simulation.expanded().bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (bodies[i].traits.type == scenes::BodyType::fixed) continue;
    const btRigidBody& body = *btRigidBody::upcast(simulation.objects()[i]);
    const btTransform pose = simulation.pose(i);
    const btVector3 &place = pose.getOrigin(), &v = body.getLinearVelocity(), &spin = body.getAngularVelocity();
    const btQuaternion turn = pose.getRotation();
    fmt::format_to(to, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", step,
                   static_cast<double>(step) * simulation.scene().time.dt, i, place.x(), place.y(), place.z(), turn.x(),
                   turn.y(), turn.z(), turn.w(), v.x(), v.y(), v.z(), spin.x(), spin.y(), spin.z());
  }
  file_.stream() << text;
}

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

std::string object_name(const scenes::Simulation& simulation, std::size_t object) {
  // In the order in which objects are numbered.
  const scenes::Scene& scene = simulation.scene();
  const std::vector<scenes::Body>& bodies = simulation.expanded().bodies;
  if (object < bodies.size()) return bodies[object].name;
  object -= bodies.size() + scene.sensors.size();
  if (object < scene.characters.size()) return scene.characters[object].name;
  object -= scene.characters.size();
  return object < scene.soft_bodies.size() ? scene.soft_bodies[object].name : "";
}

std::string events_table(const scenes::Scene& scene, const RunResult& result) {
  std::string text = "step,seconds,sensor,object,event,name\n";
  const scenes::Simulation& simulation = *result.worlds.front().simulation;
  for (const scenes::StepResult& step : result.worlds.front().steps)
    for (const effects::SensorEvent& event : step.sensor_events)
      fmt::format_to(std::back_inserter(text), "{},{},{},{},{},{}\n", step.step,
                     static_cast<double>(step.step) * scene.time.dt, in_quotes(scene.sensors[event.sensor].name),
                     event.object, event.entered ? "enter" : "leave", in_quotes(object_name(simulation, event.object)));
  return text;
}

}  // namespace boxstream::tool
