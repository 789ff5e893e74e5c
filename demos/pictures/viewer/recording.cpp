// SPDX-License-Identifier: MIT
#include "pictures/viewer/recording.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pictures/viewer/snapshot.hpp"
#include "pictures/viewer/text.hpp"

namespace boxstream::view {
namespace {

float diagonal(const Snapshot::Box& box) {
  double sum = 0;
  for (std::size_t d = 0; d < 3; ++d) sum += std::pow(static_cast<double>(box.max[d]) - box.min[d], 2);
  return static_cast<float>(std::sqrt(sum));
}

/// What a body of this size must be shown to: soft ones have nodes all over.
double fineness(const Snapshot::Box& box, Mood mood) {
  return std::ldexp(static_cast<double>(diagonal(box)), mood == Mood::soft ? -12 : -8);
}

/// A power of two below a 256th of the smallest thing that moves, or without one a 65536th of the scene; yet never so
/// fine that what leaves the scene would soon be out of reach.
float unit_of(const scenes::Bounds& bounds, const Snapshot& snapshot) {
  double extent = 0;
  for (std::size_t d = 0; d < 3; ++d) extent = std::max(extent, bounds.max[d] - bounds.min[d]);
  double unit = HUGE_VAL;
  for (std::size_t i = 0; i < snapshot.boxes.size(); ++i)
    if (snapshot.moods[i] != Mood::fixed && snapshot.moods[i] != Mood::gone && snapshot.moods[i] != Mood::wheel)
      unit = std::min(unit, fineness(snapshot.boxes[i], snapshot.moods[i]));
  if (!std::isfinite(unit)) unit = std::ldexp(extent, -16);
  unit = std::max(unit, std::ldexp(extent, -22));
  return unit > 0 && std::isfinite(unit) ? std::ldexp(1.0F, std::ilogb(unit)) : 1.0F / 1024;
}

std::uint64_t interval(const Recording::Options& options, const Snapshot& first) {
  if (options.every > 0) return options.every;
  const std::size_t expected = expected_frame_size(first.poses.size(), first.nodes.size()) * options.steps;
  return std::max<std::uint64_t>(1, (expected + options.size - 1) / options.size);
}

}  // namespace

Recording::Recording(const scenes::Simulation& simulation, const Options& options)
    : Recording(simulation, options, choose_kept(simulation, options.bodies)) {}

Recording::Recording(const scenes::Simulation& simulation, const Options& options, Kept kept)
    : simulation_(simulation),
      model_(model_of(simulation, std::move(kept))),
      unit_((snapshot_.read(simulation, model_), unit_of(simulation.scene().world.bounds, snapshot_))),
      every_(interval(options, snapshot_)),
      encoder_(unit_, model_) {
  add_frame(0);
}

void Recording::add_frame(std::uint64_t step) {
  frame_steps_.push_back(step);
  crowds_.push_back(crowd_of(snapshot_));
  snapshot_.read_contacts(simulation_, model_);
  encoder_.add(snapshot_);
  if (encoder_.is_full()) end_block();
}

void Recording::end_block() {
  blocks_.push_back(deflated(encoder_.take_block()));
}

void Recording::add_step() {
  if (++steps_ % every_ != 0) return;
  snapshot_.read(simulation_, model_);
  add_frame(steps_);
}

void Recording::finish() {
  if (!encoder_.is_empty()) end_block();
}

}  // namespace boxstream::view
