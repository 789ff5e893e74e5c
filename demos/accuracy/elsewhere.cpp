// SPDX-License-Identifier: MIT
#include "elsewhere.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

#include "formats/scene_json/load_scene.hpp"
#include "formats/scene_model/expand.hpp"
#include "formats/scene_model/names.hpp"
#include "measure.hpp"
#include "measure/stopwatch.hpp"
#include "sampling.hpp"
#include "simulation/engine/world_recipe.hpp"
#include "simulation/run/simulation.hpp"
#include "sweep.hpp"

// What goes from one program to the other and back as it is.
namespace boxstream::scenes {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Check, metric, op, value, at, at_end)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Gain, step, energy, share, body)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Work, fields, motors, surfaces, apart, other)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(EnergyBalance, steps, first, now, in_world, work, gains)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(WorstMoment, step, objects)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Vitals, deepest, deepest_share, end_share, when_deepest, joint_gap, joint_share,
                                   when_widest, outside, elsewhere, height_loss, energy, most_in_world, most_gained,
                                   vanished, conserves, failed_checks)

}  // namespace boxstream::scenes

namespace boxstream::accuracy {

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Place, position, rotation)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Series, worst, p95, mean, last, integral)

namespace {

using nlohmann::json;
using scenes::Scene;

json numbers(const std::vector<double>& values) {
  Bytes bytes(values.size() * sizeof(double));
  if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
  return json::binary(std::move(bytes));
}

std::vector<double> numbers_of(const json& document) {
  const json::binary_t& bytes = document.get_binary();
  std::vector<double> values(bytes.size() / sizeof(double));
  if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(double));
  return values;
}

json json_of(const Trajectory& trajectory) {
  std::vector<double> all;
  for (const Frame& frame : trajectory.frames)
    for (std::size_t i = 0; i < frame.positions.size(); ++i) {
      const btVector3& p = frame.positions[i];
      const btQuaternion& q = frame.rotations[i];
      for (const btScalar each : {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()}) all.push_back(double{each});
    }
  return {{"size", trajectory.size},
          {"frames", trajectory.frames.size()},
          {"bodies", trajectory.frames.empty() ? 0 : trajectory.frames.front().positions.size()},
          {"places", numbers(all)},
          {"contacts", trajectory.contacts}};
}

Trajectory trajectory_of(const json& document) {
  Trajectory trajectory;
  trajectory.size = document.at("size");
  trajectory.frames.resize(document.at("frames"));
  const std::vector<double> all = numbers_of(document.at("places"));
  const std::size_t bodies = document.at("bodies");
  const double* next = all.data();
  const auto take = [&] { return static_cast<btScalar>(*next++); };
  for (Frame& frame : trajectory.frames)
    for (std::size_t i = 0; i < bodies; ++i) {
      const btScalar x = take(), y = take(), z = take();
      frame.positions.emplace_back(x, y, z);
      const btScalar a = take(), b = take(), c = take(), w = take();
      frame.rotations.emplace_back(a, b, c, w);
    }
  document.at("contacts").get_to(trajectory.contacts);
  return trajectory;
}

json json_of(const Reference& reference) {
  return {{"trajectory", json_of(reference.trajectory)},
          {"dt", reference.dt},
          {"spread", reference.spread},
          {"error", reference.error},
          {"angle_error", reference.angle_error},
          {"holds", reference.holds}};
}

Reference reference_of(const json& document) {
  Reference reference;
  reference.trajectory = trajectory_of(document.at("trajectory"));
  document.at("dt").get_to(reference.dt);
  document.at("spread").get_to(reference.spread);
  document.at("error").get_to(reference.error);
  document.at("angle_error").get_to(reference.angle_error);
  document.at("holds").get_to(reference.holds);
  return reference;
}

json job_of(const Request& request, const Source& source, const Scene& scene, std::uint64_t steps) {
  // In the file's words, which the other program reads.
  json document = source.document;
  document["solver"]["precision"] = scenes::precision_names().at(static_cast<std::size_t>(scene.solver.precision));
  return {{"file", request.file},
          {"document", document.dump()},
          {"start", source.start},
          {"scale", request.scale},
          {"broadphase", request.broadphase},
          {"steps", steps},
          {"substeps", scene.time.substeps},
          {"iterations", scene.solver.iterations},
          {"kind", scene.solver.kind},
          {"bounces", scene.solver.bounces},
          {"checks", scene.checks}};
}

Scene scene_of(const json& job) {
  Scene scene = scenes::parse_scene(job.at("document"), job.at("file"));
  if (const double scale = job.at("scale"); scale != 1) scene = scenes::scaled(scene, scale);
  const std::vector<Place> start = job.at("start");
  if (!start.empty()) scene = placed(scene, start);
  scene.time.steps = job.at("steps");
  scene.time.substeps = job.at("substeps");
  scene.solver.iterations = job.at("iterations");
  scene.solver.kind = job.at("kind");
  scene.solver.bounces = job.at("bounces");
  scene.checks = job.at("checks");
  return scene;
}

void put_measures(const Request& request, json& job) {
  json measures = json::array();
  for (const Measure& measure : request.measures)
    measures.push_back({measure.name, static_cast<int>(measure.statistic)});
  job["measures"] = std::move(measures);
  if (request.body) job["body"] = *request.body;
  if (request.joint) job["joint"] = *request.joint;
  if (request.expected) job["expected"] = {request.expected->body, request.expected->velocity};
  json points = json::array();
  for (const Truth::Point& point : request.truth.points) points.push_back({point.seconds, point.place});
  job["truth"] = std::move(points);
  job["keep_values"] = request.keep_values;
}

Request request_of(const json& job) {
  Request request;
  request.file = job.at("file");
  request.broadphase = job.at("broadphase");
  for (const json& each : job.at("measures")) {
    request.measures.push_back(parse_measure(each.at(0)));
    request.measures.back().statistic = static_cast<Measure::Statistic>(each.at(1).get<int>());
  }
  if (job.contains("body")) request.body = job.at("body").get<std::size_t>();
  if (job.contains("joint")) request.joint = job.at("joint").get<std::size_t>();
  if (job.contains("expected")) request.expected = Expected{job.at("expected").at(0), job.at("expected").at(1)};
  for (const json& point : job.at("truth")) request.truth.points.push_back({point.at(0), point.at(1)});
  request.keep_values = job.at("keep_values");
  return request;
}

Bytes bytes_of(const json& document) {
  return json::to_cbor(document);
}

}  // namespace

bool is_for_elsewhere(const Scene& scene) {
  return scene.solver.precision != scenes::precision_here;
}

Scene here(Scene scene) {
  scene.solver.precision = scenes::precision_here;
  return scene;
}

bool sample_elsewhere(const Request& request, const Source& source, const Scene& scene, const Reference& reference,
                      Row& row, Trajectory* trajectory, double most_seconds) {
  json job = job_of(request, source, scene, row.steps);
  put_measures(request, job);
  job["reference"] = json_of(reference);
  job["records"] = trajectory != nullptr;
  if (std::isfinite(most_seconds)) job["seconds"] = most_seconds;
  const Bytes said = request.elsewhere(bytes_of(job));
  if (said.empty()) return false;
  const json answer = json::from_cbor(said);
  if (answer.at("is_stopped").get<bool>()) return false;
  answer.at("series").get_to(row.series);
  answer.at("bands").get_to(row.bands);
  answer.at("values").get_to(row.values);
  const double ms = answer.at("ms");
  row.ms = {ms, ms, ms, ms};
  row.vitals = answer.at("vitals");
  if (const auto gain = answer.find("worst_gain"); gain != answer.end()) row.vitals.energy.worst = *gain;
  row.failure = answer.at("failure");
  if (trajectory != nullptr) *trajectory = trajectory_of(answer.at("trajectory"));
  return true;
}

double time_elsewhere(const Request& request, const Source& source, const Scene& scene, std::uint64_t steps) {
  const Bytes said = request.elsewhere(bytes_of(job_of(request, source, scene, steps)));
  return said.empty() ? NAN : json::from_cbor(said).at("ms").get<double>();
}

Bytes answer_job(const Bytes& given, const std::function<json(const Scene& scene)>& document) {
  const json job = json::from_cbor(given);
  const Scene scene = scene_of(job);
  const std::uint64_t steps = job.at("steps");
  if (!job.contains("measures")) return bytes_of({{"ms", timed(scene, job.at("broadphase"), steps)}});
  Request request = request_of(job);
  request.document = document;
  if (job.contains("seconds"))
    request.stop = [most = job.at("seconds").get<double>(), elapsed = measure::Elapsed()] {
      return elapsed.seconds() > most;
    };
  Row row;
  row.steps = steps;
  Trajectory trajectory;
  const bool records = job.at("records");
  if (!run_and_sample(request, scene, reference_of(job.at("reference")), row, records ? &trajectory : nullptr))
    return bytes_of({{"is_stopped", true}});
  json answer{{"is_stopped", false}, {"series", row.series}, {"bands", row.bands},    {"values", row.values},
              {"ms", row.ms.median}, {"vitals", row.vitals}, {"failure", row.failure}};
  if (row.vitals.energy.worst) answer["worst_gain"] = *row.vitals.energy.worst;
  if (records) answer["trajectory"] = json_of(trajectory);
  return bytes_of(answer);
}

}  // namespace boxstream::accuracy
