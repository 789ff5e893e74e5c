// SPDX-License-Identifier: MIT
#include "run_and_sample.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <BulletDynamics/Dynamics/btRigidBody.h>

#include "monitor.hpp"
#include "simulation/run/simulation.hpp"

namespace boxstream::accuracy {
namespace {

using scenes::Check;
using scenes::Scene;
using scenes::Simulation;
using Kind = Measure::Kind;

constexpr double collapse_loss = 0.1;  ///< of the height

/// How a run goes beside the reference, at the times that both have.
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
    const double frames = time / reference_.dt, whole = std::round(frames);
    if (whole < 1 || std::abs(frames - whole) > 1e-6 * whole) return;
    const auto place = static_cast<std::size_t>(whole) - 1;
    if (place >= reference_.trajectory.frames.size()) return;
    const Frame now = frame_of(simulation);
    times_.push_back(time);
    distances_.push_back(distance(now, reference_.trajectory.frames[place]));
    angles_.push_back(angle(now, reference_.trajectory.frames[place]));
  }

  std::vector<double> values(const Measure& measure, double seconds) const {
    if (times_.empty()) return {NAN};
    if (measure.kind == Kind::trajectory) return distances_;
    if (measure.kind == Kind::orientation) return angles_;
    const double parting = divergence_time(own_, reference_.trajectory, dt_ + reference_.dt, seconds);
    if (measure.kind == Kind::agrees_for) return {parting};
    std::vector<double> agreeing;
    for (std::size_t i = 0; i < times_.size(); ++i)
      if (times_[i] < parting || parting >= seconds) agreeing.push_back(distances_[i]);
    return agreeing.empty() ? std::vector<double>{NAN} : agreeing;
  }

 private:
  const Reference& reference_;
  double dt_;
  Trajectory own_;
  std::vector<double> times_, distances_, angles_;
};

/// Worlds take the numbers of checks that they have, so this one has a check of each, which always holds.
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
void take(const Monitor& monitor, const std::vector<Measure>& measures, std::vector<std::vector<double>>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    Measure of_moment = measures[i];
    if (of_moment.kind > Kind::stands) continue;
    if (of_moment.kind > Kind::tunnelled) of_moment.kind = Kind::height_loss;
    values[i].push_back(monitor.value(of_moment));
  }
}

std::vector<double> fall(const std::vector<double>& losses, double dt, Kind kind) {
  const auto fallen = std::find_if(losses.begin(), losses.end(), [](double loss) { return !(loss <= collapse_loss); });
  if (kind == Kind::stands) return {fallen == losses.end() ? 1.0 : 0.0};
  const auto steps = std::min(fallen - losses.begin() + 1, losses.end() - losses.begin());
  return {static_cast<double>(steps) * dt};
}

}  // namespace

void run_and_sample(const Request& request, const Scene& scene, const Reference& reference, Row& row) {
  const double dt = scene.time.dt, seconds = static_cast<double>(row.steps) * dt;
  Simulation simulation(with_checks(request, scene), request.broadphase);
  const Monitor monitor(simulation);
  Comparison comparison(reference, simulation);
  std::vector<std::vector<double>> values(request.measures.size());
  for (std::uint64_t step = 1; step <= row.steps && row.failure.empty(); ++step) {
    simulation.advance();
    take(monitor, request.measures, values);
    if (!reference.trajectory.frames.empty()) comparison.follow(simulation, step);
    if (!simulation.is_finite())
      row.failure = "a coordinate is not finite after step " + std::to_string(step);
    else if (monitor.has_exploded())
      row.failure = "exploded in step " + std::to_string(step) + ": ten times as fast as a fall through the scene";
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Measure& measure = request.measures[i];
    if (measure.kind == Kind::collapse_time || measure.kind == Kind::stands)
      values[i] = fall(values[i], dt, measure.kind);
    else if (measure.kind == Kind::velocity_error || measure.kind == Kind::direction_error)
      values[i] = {beside_expected(request, simulation, measure.kind)};
    else if (measure.kind == Kind::repeatable)
      values[i] = {last_bits(request, scene, row.steps) == simulation.state_hash() ? 1.0 : 0.0};
    else if (needs_reference(measure))
      values[i] = comparison.values(measure, seconds);
    row.series.push_back(summed_up(measure, values[i], seconds));
  }
  if (request.keep_values) row.values = std::move(values);
}

}  // namespace boxstream::accuracy
