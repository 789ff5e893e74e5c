// SPDX-License-Identifier: MIT
#include "reference.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace boxstream::accuracy {
namespace {

constexpr double least_ratio = 1.5;

double estimate_of(double before, double last) {
  return before > least_ratio * last ? last / (before / last - 1) : std::max(before, last);
}

/// One for each frame, of two successive distances between the last three runs.
std::vector<double> errors(const std::vector<Member>& sequence, double (*apart)(const Frame&, const Frame&)) {
  const std::vector<Frame>& last = sequence.back().trajectory.frames;
  const std::vector<Frame>& former = sequence[sequence.size() - 2].trajectory.frames;
  std::vector<double> all;
  for (std::size_t i = 0; i < last.size(); ++i) {
    const double difference = apart(former[i], last[i]);
    const double before =
        sequence.size() < 3 ? difference : apart(sequence[sequence.size() - 3].trajectory.frames[i], former[i]);
    // It does not get better again: what came later follows from what was wrong before.
    all.push_back(std::max(all.empty() ? 0.0 : all.back(), estimate_of(before, difference)));
  }
  return all;
}

/// Until the error is no small part of the way that bodies have gone.
double holding_time(const std::vector<double>& error, const Trajectory& trajectory, double dt) {
  const std::vector<Frame>& frames = trajectory.frames;
  double way = trajectory.size / 10;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    way = std::max(way, distance(frames[i], frames.front()));
    if (error[i] > std::max(1e-6, most_reference_error * way)) return static_cast<double>(i) * dt;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

Reference estimated(const std::vector<Member>& sequence, const std::vector<Measure>& measures, double dt) {
  const Member& last = sequence.back();
  Reference reference;
  reference.trajectory = last.trajectory;
  reference.dt = dt;
  reference.series = last.series;
  reference.vitals = last.vitals;
  reference.stands_alike = std::all_of(sequence.begin(), sequence.end(), [&](const Member& member) {
    return scenes::falls_alike(member.vitals.height_loss, last.vitals.height_loss);
  });
  if (sequence.size() < 2) return reference;
  reference.loses_alike = std::all_of(sequence.begin(), sequence.end(), [&](const Member& member) {
    return std::abs(member.vitals.energy.lost_for_good() - last.vitals.energy.lost_for_good()) <=
           scenes::most_energy_apart / 4 * last.vitals.most_in_world;
  });
  const Member& former = sequence[sequence.size() - 2];
  for (std::size_t m = 0; m < measures.size(); ++m) {
    const double difference = std::abs(last.series[m].of(measures[m]) - former.series[m].of(measures[m]));
    const double before =
        sequence.size() < 3
            ? difference
            : std::abs(former.series[m].of(measures[m]) - sequence[sequence.size() - 3].series[m].of(measures[m]));
    reference.spread.push_back(estimate_of(before, difference));
  }
  reference.error = errors(sequence, distance);
  reference.angle_error = errors(sequence, angle);
  reference.holds = holding_time(reference.error, last.trajectory, dt);
  return reference;
}

}  // namespace boxstream::accuracy
