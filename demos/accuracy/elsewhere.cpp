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

namespace boxstream::accuracy {
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
  json contacts = json::array();
  for (const auto& [pair, time] : trajectory.contacts) contacts.push_back({pair.first, pair.second, time});
  return {{"size", trajectory.size},
          {"frames", trajectory.frames.size()},
          {"bodies", trajectory.frames.empty() ? 0 : trajectory.frames.front().positions.size()},
          {"places", numbers(all)},
          {"contacts", std::move(contacts)}};
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
  for (const json& each : document.at("contacts"))
    trajectory.contacts[{each.at(0).get<int>(), each.at(1).get<int>()}] = each.at(2);
  return trajectory;
}

json json_of(const Reference& reference) {
  return {{"trajectory", json_of(reference.trajectory)},   {"dt", reference.dt},
          {"spread", numbers(reference.spread)},           {"error", numbers(reference.error)},
          {"angle_error", numbers(reference.angle_error)}, {"holds", numbers({reference.holds})}};
}

Reference reference_of(const json& document) {
  Reference reference;
  reference.trajectory = trajectory_of(document.at("trajectory"));
  reference.dt = document.at("dt");
  reference.spread = numbers_of(document.at("spread"));
  reference.error = numbers_of(document.at("error"));
  reference.angle_error = numbers_of(document.at("angle_error"));
  reference.holds = numbers_of(document.at("holds")).at(0);
  return reference;
}

/// Both ways: all numbers of a run's vitals, in one order.
template <class Vitals, class Visit>
void visit(Vitals& v, const Visit& take) {
  for (auto* each : {&v.deepest, &v.deepest_share, &v.end_share, &v.joint_gap, &v.joint_share, &v.elsewhere,
                     &v.height_loss, &v.most_in_world, &v.most_gained, &v.vanished, &v.energy.first, &v.energy.now,
                     &v.energy.in_world, &v.energy.work.fields, &v.energy.work.motors, &v.energy.work.surfaces,
                     &v.energy.work.apart, &v.energy.work.other})
    take(*each);
  for (auto* each : {&v.outside, &v.energy.steps, &v.energy.gains, &v.when_deepest.step, &v.when_widest.step})
    take(*each);
  for (auto* moment : {&v.when_deepest, &v.when_widest})
    for (auto& each : moment->objects) take(each);
  take(v.conserves);
}

json json_of(const scenes::Vitals& vitals) {
  std::vector<double> all;
  visit(vitals, [&](const auto& value) { all.push_back(static_cast<double>(value)); });
  json document{{"numbers", numbers(all)}, {"failed_checks", vitals.failed_checks}};
  if (const auto& worst = vitals.energy.worst)
    document["worst"] = {worst->step, worst->energy, worst->share, worst->body};
  return document;
}

scenes::Vitals vitals_of(const json& document) {
  scenes::Vitals vitals;
  const std::vector<double> all = numbers_of(document.at("numbers"));
  std::size_t next = 0;
  visit(vitals, [&](auto& value) { value = static_cast<std::remove_reference_t<decltype(value)>>(all.at(next++)); });
  vitals.failed_checks = document.at("failed_checks").get<std::vector<std::string>>();
  if (const auto worst = document.find("worst"); worst != document.end())
    vitals.energy.worst = scenes::Gain{worst->at(0), worst->at(1), worst->at(2), worst->at(3)};
  return vitals;
}

json job_of(const Request& request, const Source& source, const Scene& scene, std::uint64_t steps) {
  json start = json::array();
  for (const Place& place : source.start) start.push_back({place.position, place.rotation});
  json checks = json::array();
  for (const scenes::Check& c : scene.checks)
    checks.push_back({static_cast<int>(c.metric), static_cast<int>(c.op), c.value, c.at, c.at_end});
  // In the file's words, which the other program reads.
  json document = source.document;
  document["solver"]["precision"] = scenes::precision_names().at(static_cast<std::size_t>(scene.solver.precision));
  return {{"file", request.file},
          {"document", document.dump()},
          {"start", std::move(start)},
          {"scale", request.scale},
          {"broadphase", request.broadphase},
          {"steps", steps},
          {"substeps", scene.time.substeps},
          {"iterations", scene.solver.iterations},
          {"kind", static_cast<int>(scene.solver.kind)},
          {"bounces", static_cast<int>(scene.solver.bounces)},
          {"checks", std::move(checks)}};
}

Scene scene_of(const json& job) {
  Scene scene = scenes::parse_scene(job.at("document"), job.at("file"));
  if (const double scale = job.at("scale"); scale != 1) scene = scenes::scaled(scene, scale);
  std::vector<Place> start;
  for (const json& place : job.at("start")) start.push_back({place.at(0), place.at(1)});
  if (!start.empty()) scene = placed(scene, start);
  scene.time.steps = job.at("steps");
  scene.time.substeps = job.at("substeps");
  scene.solver.iterations = job.at("iterations");
  scene.solver.kind = static_cast<scenes::SolverKind>(job.at("kind").get<int>());
  scene.solver.bounces = static_cast<scenes::Bounces>(job.at("bounces").get<int>());
  scene.checks.clear();
  for (const json& c : job.at("checks"))
    scene.checks.push_back({static_cast<scenes::Check::Metric>(c.at(0).get<int>()),
                            static_cast<scenes::Check::Op>(c.at(1).get<int>()), c.at(2), c.at(3), c.at(4)});
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
  for (const json& series : answer.at("series")) {
    const std::vector<double> all = numbers_of(series);
    row.series.push_back({all.at(0), all.at(1), all.at(2), all.at(3), all.at(4)});
  }
  row.bands = numbers_of(answer.at("bands"));
  for (const json& values : answer.at("values")) row.values.push_back(numbers_of(values));
  const double ms = answer.at("ms");
  row.ms = {ms, ms, ms, ms};
  row.vitals = vitals_of(answer.at("vitals"));
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
  json series = json::array(), values = json::array();
  for (const Series& each : row.series)
    series.push_back(numbers({each.worst, each.p95, each.mean, each.last, each.integral}));
  for (const std::vector<double>& each : row.values) values.push_back(numbers(each));
  json answer{{"is_stopped", false},         {"series", std::move(series)}, {"bands", numbers(row.bands)},
              {"values", std::move(values)}, {"ms", row.ms.median},         {"vitals", json_of(row.vitals)},
              {"failure", row.failure}};
  if (records) answer["trajectory"] = json_of(trajectory);
  return bytes_of(answer);
}

}  // namespace boxstream::accuracy
