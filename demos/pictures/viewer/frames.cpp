// SPDX-License-Identifier: MIT
#include "pictures/viewer/frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace boxstream::view {
namespace {

constexpr double box_quantum = 2;  // units

std::vector<std::int32_t> in_sixteenths(std::vector<std::int32_t> values) {
  for (std::int32_t& value : values) value *= Series::fine;
  return values;
}

}  // namespace

std::vector<std::uint32_t> turning(const Model& model) {
  std::vector<bool> turns(model.states.size());
  for (const Part& part : model.parts)
    if (model.forms[part.form].kind != scenes::Drawable::Kind::sphere || part.position != Point{})
      turns[part.object] = true;
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < turns.size(); ++i)
    if (turns[i]) list.push_back(i);
  return list;
}

FrameEncoder::FrameEncoder(float unit, const Model& model) : unit_(unit), turning_(turning(model)), pairs_(unit) {}

std::int32_t FrameEncoder::fixed(double value, double quantum) const {
  if (std::isnan(value)) return Series::not_a_number;
  const auto most = static_cast<double>(Series::largest);
  return static_cast<std::int32_t>(std::lround(std::clamp(value / quantum * Series::fine, -most, most)));
}

void FrameEncoder::code_places(const Snapshot& snapshot) {
  former_places_ = places_.at();
  numbers_.clear();
  for (const Pose& pose : snapshot.poses)
    for (const float x : pose.position) numbers_.push_back(fixed(x, unit_));
  for (const Point& node : snapshot.nodes)
    for (const float x : node) numbers_.push_back(fixed(x, unit_));
  places_.code(numbers_, block_);
  if (former_places_.empty()) former_places_ = places_.at();
}

void FrameEncoder::code_rotations(const Snapshot& snapshot) {
  numbers_.clear();
  for (const std::uint32_t object : turning_)
    for (const float x : snapshot.poses[object].rotation) {
      const float part = std::isfinite(x) ? std::clamp(x, -1.0F, 1.0F) : 0.0F;
      numbers_.push_back(fixed(part, rotation_unit));
    }
  rotations_.code(numbers_, block_);
}

void FrameEncoder::code_boxes(const Snapshot& snapshot) {
  const double quantum = box_quantum * unit_;
  const double reach = std::ldexp(static_cast<double>(unit_), 25);
  numbers_.assign(6 * snapshot.boxes.size(), Series::not_a_number);
  for (std::size_t i = 0; i < snapshot.boxes.size(); ++i) {
    const Snapshot::Box& box = snapshot.boxes[i];
    for (std::size_t d = 0; d < 3 && box.min[d] <= box.max[d]; ++d) {
      const std::int32_t from = former_places_[3 * i + d];
      const double place = from == Series::not_a_number ? 0 : double{unit_} * from / Series::fine;
      const double min = std::clamp<double>(box.min[d], -reach, reach),
                   max = std::clamp<double>(box.max[d], -reach, reach);
      numbers_[6 * i + d] = fixed((min + max) / 2 - place, quantum);
      numbers_[6 * i + 3 + d] = fixed(max - min, quantum);
    }
  }
  boxes_.code(numbers_, block_);
}

void FrameEncoder::add(const Snapshot& snapshot) {
  code_places(snapshot);
  code_rotations(snapshot);
  code_boxes(snapshot);
  islands_.code(in_sixteenths(snapshot.islands), block_);
  numbers_.clear();
  for (const Mood mood : snapshot.moods) numbers_.push_back(static_cast<std::int32_t>(mood));
  moods_.code(in_sixteenths(numbers_), block_);
  pairs_.code(snapshot, former_places_, block_);
  ++frames_;
}

std::string FrameEncoder::take_block() {
  for (Series* const series : {&places_, &rotations_, &boxes_, &islands_, &moods_}) series->restart();
  pairs_.restart();
  frames_ = 0;
  return std::exchange(block_, {});
}

std::size_t expected_frame_size(std::size_t objects, std::size_t nodes) {
  constexpr std::size_t bytes_of_object = 6;
  constexpr std::size_t bytes_of_node = 2;
  return bytes_of_object * objects + bytes_of_node * nodes;
}

}  // namespace boxstream::view
