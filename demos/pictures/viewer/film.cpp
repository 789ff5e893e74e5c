// SPDX-License-Identifier: MIT
#include "pictures/viewer/film.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::view {
namespace {

// Of each soft body, at most: every one is a surface of its own.
constexpr std::uint64_t most_stills = 60;
// Place and rotation.
constexpr std::size_t bytes_of_sample = 28;

/// The pose with nothing in it that is not finite: files must not have that.
Pose finite(const Pose& pose, const Pose& former) {
  const auto all_finite = [](const auto& values) {
    return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
  };
  return {all_finite(pose.position) ? pose.position : former.position,
          all_finite(pose.rotation) ? pose.rotation : former.rotation};
}

std::uint64_t interval(const Film::Options& options, std::size_t objects) {
  if (options.every > 0) return options.every;
  const std::size_t expected = bytes_of_sample * objects * options.steps;
  return std::max<std::uint64_t>(1, (expected + Film::file_size - 1) / Film::file_size);
}

}  // namespace

Film::Film(const scenes::Simulation& simulation, const Options& options)
    : simulation_(simulation),
      versions_(options.versions),
      every_(interval(options, simulation.objects().size())),
      still_every_(std::max<std::uint64_t>(1, (options.steps / every_ + most_stills - 1) / most_stills)) {
  film_.model = model_of(simulation);
  latest_.resize(film_.model.states.size());
  film_.places.resize(film_.model.states.size());
  film_.rotations.resize(film_.model.states.size());
  film_.scales.resize(film_.model.states.size());
  film_.stills.resize(film_.model.soft_parts.size());
  take_frame();
  film_.first = latest_;
  for (const Mood mood : snapshot_.moods) film_.in_world.push_back(mood != Mood::gone);
}

void Film::add_step() {
  if (++steps_ % every_ == 0) take_frame();
}

void Film::take_frame() {
  snapshot_.read(simulation_, film_.model);
  const std::uint32_t frame = frames_++;
  for (std::size_t i = 0; i < snapshot_.poses.size(); ++i) {
    latest_[i] = finite(snapshot_.poses[i], latest_[i]);
    film_.places[i].add(frame, latest_[i].position);
    film_.rotations[i].add(frame, latest_[i].rotation);
    const float scale = snapshot_.moods[i] == Mood::gone ? 0.0F : 1.0F;
    film_.scales[i].add(frame, {scale, scale, scale});
  }
  if (frame % still_every_ != 0) return;
  for (std::size_t i = 0; i < film_.stills.size(); ++i) take_still(frame, film_.model.soft_parts[i], film_.stills[i]);
}

void Film::take_still(std::uint32_t frame, const SoftPart& part, std::vector<FilmRecord::Still>& list) const {
  const auto begin = snapshot_.nodes.begin() + part.first_node;
  const auto end = begin + part.nodes;
  const bool is_finite = std::all_of(
      begin, end, [](const Point& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); });
  if (!is_finite || (!list.empty() && std::equal(begin, end, list.back().nodes.begin()))) return;
  list.push_back({frame, {begin, end}});
}

void Film::write(std::ostream& out) const {
  write_glb(out, film_, simulation_.scene(), simulation_.scene().time.dt * static_cast<double>(every_), versions_);
}

}  // namespace boxstream::view
