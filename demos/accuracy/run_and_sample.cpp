// SPDX-License-Identifier: MIT
#include "sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "measure/stopwatch.hpp"
#include "monitor.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Check;
using scenes::Scene;
using scenes::Simulation;
using Kind = Measure::Kind;

constexpr double collapse_loss = 0.1;  ///< of the height

/// How a run goes beside the reference, at the times that both have, as long as the reference holds.
class Comparison {
 public:
  Comparison(const Reference& reference, Simulation& simulation)
      : reference_(reference), dt_(simulation.scene().time.dt) {
    if (!reference.trajectory.frames.empty()) record_contacts_within(simulation, own_);
  }
  Comparison(const Comparison&) = delete;
  Comparison& operator=(const Comparison&) = delete;

  void follow(Simulation& simulation, std::uint64_t step) {
    const double time = static_cast<double>(step) * dt_;
    record_contacts(simulation, time, own_);
    if (time > reference_.holds) return;
    const double frames = time / reference_.dt, whole = std::round(frames);
    if (whole < 1 || std::abs(frames - whole) > 1e-6 * whole) return;
    const auto place = static_cast<std::size_t>(whole) - 1;
    if (place >= reference_.trajectory.frames.size()) return;
    const Frame now = frame_of(simulation);
    times_.push_back(time);
    distances_.push_back(distance(now, reference_.trajectory.frames[place]));
    angles_.push_back(angle(now, reference_.trajectory.frames[place]));
    if (!reference_.is_estimated()) return;
    errors_.push_back(reference_.error[place]);
    angle_errors_.push_back(reference_.angle_error[place]);
  }

  /// See scenes::Vitals.
  double elsewhere() const {
    const std::vector<Frame>& frames = reference_.trajectory.frames;
    if (distances_.empty() || !reference_.is_estimated()) return 0;
    double way = std::max(reference_.trajectory.size, extent(frames.front()) / 10), sum = 0;
    for (std::size_t i = 0; i < frames.size() && static_cast<double>(i) * reference_.dt <= reference_.holds; ++i)
      way = std::max(way, distance(frames[i], frames.front()));
    for (const double each : distances_) sum += each;
    return way > 0 ? sum / static_cast<double>(distances_.size()) / way : 0;
  }

  std::vector<double> values(const Measure& measure, double seconds) const {
    if (times_.empty()) return {NAN};
    if (measure.kind == Kind::trajectory) return distances_;
    if (measure.kind == Kind::orientation) return angles_;
    const double end = std::min(seconds, reference_.holds);
    const double parting = divergence_time(own_, reference_.trajectory, dt_ + reference_.dt, end);
    if (measure.kind == Kind::agrees_for) return {parting};
    return while_agreeing(distances_, parting, end);
  }

  /// By how much the reference may be off in what `values` says; empty where that is not known.
  std::vector<double> errors(const Measure& measure, double seconds) const {
    if (measure.kind == Kind::trajectory) return errors_;
    if (measure.kind == Kind::orientation) return angle_errors_;
    if (measure.kind == Kind::agrees_for || errors_.empty()) return {};
    const double end = std::min(seconds, reference_.holds);
    return while_agreeing(errors_, divergence_time(own_, reference_.trajectory, dt_ + reference_.dt, end), end);
  }

 private:
  std::vector<double> while_agreeing(const std::vector<double>& all, double parting, double end) const {
    std::vector<double> agreeing;
    for (std::size_t i = 0; i < times_.size(); ++i)
      if (times_[i] < parting || parting >= end) agreeing.push_back(all[i]);
    return agreeing.empty() ? std::vector<double>{NAN} : agreeing;
  }

  const Reference& reference_;
  double dt_;
  Trajectory own_;
  std::vector<double> times_, distances_, angles_, errors_, angle_errors_;
};

/// How far a body is from where it is known to be, at those times of the truth that the run has come to. Between two
/// steps it goes straight.
class BesideTruth {
 public:
  BesideTruth(const Request& request, const Simulation& simulation) : request_(request) {
    if (!request.truth.points.empty()) follow(simulation, 0);
  }

  void follow(const Simulation& simulation, double time) {
    const auto& points = request_.truth.points;
    if (next_ >= points.size()) return;
    const btVector3 place = simulation.pose(*request_.body).getOrigin();
    const std::array<double, 3> now{place.x(), place.y(), place.z()};
    for (; next_ < points.size() && points[next_].seconds <= time * (1 + 1e-9); ++next_) {
      const double part = time > time_ ? (points[next_].seconds - time_) / (time - time_) : 1;
      double sum = 0;
      for (std::size_t d = 0; d < 3; ++d)
        sum += std::pow(before_[d] + part * (now[d] - before_[d]) - points[next_].place[d], 2);
      distances.push_back(std::sqrt(sum));
    }
    before_ = now;
    time_ = time;
  }

  std::vector<double> distances;

 private:
  const Request& request_;
  std::size_t next_ = 0;
  double time_ = 0;
  std::array<double, 3> before_{};
};

/// Worlds take the numbers of checks that they have, so this one has a check of each, which always holds, behind those
/// of the scene.
Scene with_checks(const Request& request, Scene scene) {
  for (const Measure& measure : request.measures)
    if (measure.kind == Kind::metric) scene.checks.push_back({measure.metric, Check::Op::at_most, HUGE_VAL, 0, false});
  return scene;
}

std::uint64_t last_bits(const Request& request, const Scene& scene, std::uint64_t steps) {
  Simulation simulation(scene, request.broadphase);
  while (simulation.steps_done() < steps) simulation.advance();
  return simulation.state_hash();
}

double beside_expected(const Request& request, const Simulation& simulation, Kind kind) {
  if (!request.expected || request.expected->body >= simulation.objects().size()) return NAN;
  const auto* const body = btRigidBody::upcast(simulation.objects()[request.expected->body]);
  const auto& [x, y, z] = request.expected->velocity;
  const double v[3] = {body->getLinearVelocity().x(), body->getLinearVelocity().y(), body->getLinearVelocity().z()};
  if (kind == Kind::velocity_error) return std::hypot(v[0] - x, v[1] - y, v[2] - z) / std::hypot(x, y, z);
  const double across = std::hypot(v[1] * z - v[2] * y, v[2] * x - v[0] * z, v[0] * y - v[1] * x);
  return std::atan2(across, v[0] * x + v[1] * y + v[2] * z) * 180 / std::numbers::pi;
}

/// Of each step; none for what is known only at the end.
void take(const Monitor& monitor, const Request& request, std::vector<std::vector<double>>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    Measure of_moment = request.measures[i];
    const bool of_body = is_of_body(of_moment);
    if (of_moment.kind > Kind::stands && !of_body) continue;
    if (of_body) {
      values[i].push_back(monitor.value(of_moment, request.body));
      continue;
    }
    if (of_moment.kind > Kind::tunnelled) of_moment.kind = Kind::height_loss;
    values[i].push_back(monitor.value(of_moment, {}, request.joint));
  }
}

/// A number, or true or false, in what a run says; NaN: there is none.
double field_of(const nlohmann::json& document, const std::string& name) {
  const nlohmann::json::json_pointer pointer(name);
  if (!document.contains(pointer)) return NAN;
  const nlohmann::json& value = document[pointer];
  if (value.is_boolean()) return value.get<bool>() ? 1 : 0;
  return value.is_number() ? value.get<double>() : NAN;
}

std::vector<double> fall(const std::vector<double>& losses, double dt, Kind kind) {
  const auto fallen = std::find_if(losses.begin(), losses.end(), [](double loss) { return !(loss <= collapse_loss); });
  if (kind == Kind::stands) return {fallen == losses.end() ? 1.0 : 0.0};
  const auto steps = std::min(fallen - losses.begin() + 1, losses.end() - losses.begin());
  return {static_cast<double>(steps) * dt};
}

}  // namespace

bool run_and_sample(const Request& request, const Scene& scene, const Reference& reference, Row& row,
                    Trajectory* trajectory) {
  const double dt = scene.time.dt, seconds = static_cast<double>(row.steps) * dt;
  Simulation simulation(with_checks(request, scene), request.broadphase);
  const Monitor monitor(simulation);
  scenes::VitalsMonitor vitals(simulation);
  Comparison comparison(reference, simulation);
  BesideTruth beside_truth(request, simulation);
  if (trajectory != nullptr) {
    trajectory->size = size_of_bodies(simulation);
    record_contacts_within(simulation, *trajectory);
  }
  std::vector<std::vector<double>> values(request.measures.size());
  double ms = 0;
  for (std::uint64_t step = 1; step <= row.steps && row.failure.empty(); ++step) {
    if (request.stop && request.stop()) return false;
    const auto start = measure::now(simulation.clock());
    simulation.advance(true);
    ms += measure::milliseconds(measure::now(simulation.clock()) - start);
    vitals.look();
    take(monitor, request, values);
    beside_truth.follow(simulation, static_cast<double>(step) * dt);
    if (!reference.trajectory.frames.empty()) comparison.follow(simulation, step);
    if (trajectory != nullptr) {
      trajectory->frames.push_back(frame_of(simulation));
      record_contacts(simulation, static_cast<double>(step) * dt, *trajectory);
    }
    if (!simulation.is_finite())
      row.failure = "a coordinate is not finite after step " + std::to_string(step);
    else if (monitor.has_exploded())
      row.failure = "exploded in step " + std::to_string(step) + ": ten times as fast as a fall through the scene";
  }
  row.vitals = vitals.vitals();
  row.vitals.height_loss = monitor.height_loss();
  row.vitals.elsewhere = comparison.elsewhere();
  row.ms = {ms / seconds, ms / seconds, ms / seconds, ms / seconds};
  const bool is_asked = std::any_of(request.measures.begin(), request.measures.end(),
                                    [](const Measure& measure) { return measure.kind == Kind::field; });
  const nlohmann::json document =
      is_asked && request.document && row.failure.empty() ? request.document(scene) : nlohmann::json();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Measure& measure = request.measures[i];
    double band = NAN;
    if (measure.kind == Kind::collapse_time || measure.kind == Kind::stands)
      values[i] = fall(values[i], dt, measure.kind);
    else if (measure.kind == Kind::velocity_error || measure.kind == Kind::direction_error)
      values[i] = {beside_expected(request, simulation, measure.kind)};
    else if (measure.kind == Kind::field)
      values[i] = {field_of(document, measure.name)};
    else if (measure.kind == Kind::truth)
      values[i] = beside_truth.distances.empty() ? std::vector<double>{NAN} : beside_truth.distances;
    else if (measure.kind == Kind::repeatable)
      values[i] = {last_bits(request, scene, row.steps) == simulation.state_hash() ? 1.0 : 0.0};
    else if (needs_reference(measure)) {
      values[i] = comparison.values(measure, seconds);
      if (const auto errors = comparison.errors(measure, seconds); !errors.empty())
        band = summed_up(measure, errors, seconds).of(measure);
    } else if (better(measure) == Better::as_reference && i < reference.spread.size()) {
      band = reference.spread[i];
    }
    row.series.push_back(summed_up(measure, values[i], seconds));
    row.bands.push_back(band);
  }
  if (request.keep_values) row.values = std::move(values);
  return true;
}

}  // namespace boxstream::accuracy
