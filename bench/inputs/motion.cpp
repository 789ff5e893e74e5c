// SPDX-License-Identifier: MIT
#include "inputs/motion.hpp"

#include <cmath>
#include <numeric>
#include <utility>

namespace boxstream::bench {

namespace {

constexpr MotionName names[] = {
    {"brown", Motion::brown, "every box moves up to 10 % of its side on each axis"},
    {"static5", Motion::static5, "the same 5 % of the boxes move like that, the others are not touched"},
    {"one", Motion::one, "the same one of them moves like that"},
    {"fall", Motion::fall, "all fall along -y, each with its own start speed, accelerated together"},
    {"teleport", Motion::teleport, "every box takes the place of another one"},
    {"asleep", Motion::asleep, "no box moves, but all are set again"},
    {"tremble", Motion::tremble, "every box is up to 0.1 % of its side from its place, as in a pile that is awake"},
};

constexpr double fastest_start = 0.05;    // mean sides a frame
constexpr double acceleration = 0.003;    // mean sides a frame, in each frame
constexpr std::size_t one_in_moves = 20;  // of `static5`
constexpr double trembling = 0.001;       // of the own side

double mean_side(const std::vector<Aabb>& boxes) {
  double sum = 0;
  for (const Aabb& box : boxes)
    for (int d = 0; d < 3; ++d) sum += static_cast<double>(box.max[d]) - static_cast<double>(box.min[d]);
  return boxes.empty() ? 0 : sum / (3 * static_cast<double>(boxes.size()));
}

}  // namespace

Span<const MotionName> motions() {
  return names;
}

std::vector<Aabb> scaled_to_unit_sides(std::vector<Aabb> boxes) {
  const double mean = mean_side(boxes);
  if (!(mean > 0) || !std::isfinite(mean)) return boxes;
  const int exponent = -static_cast<int>(std::lround(std::log2(mean)));
  for (Aabb& box : boxes)
    for (int d = 0; d < 3; ++d) {
      box.min[d] = std::ldexp(box.min[d], exponent);
      box.max[d] = std::ldexp(box.max[d], exponent);
    }
  return boxes;
}

MovingBoxes::MovingBoxes(std::vector<Aabb> boxes, Motion motion, std::uint64_t seed)
    : start_(std::move(boxes)),
      boxes_(start_),
      motion_(motion),
      step_(Brownian{}.step),
      random_(seed),
      offsets_(3 * start_.size(), 0.0),
      mean_side_(mean_side(start_)) {
  for (std::size_t i = 0; i < start_.size(); ++i)
    if (motion == Motion::one ? i == start_.size() / 2
                              : motion != Motion::static5 || random_.integer(1, one_in_moves) == 1)
      moved_.push_back(static_cast<std::uint32_t>(i));
  if (motion == Motion::fall)
    for (std::size_t i = 0; i < start_.size(); ++i) speeds_.push_back(random_.real(0, fastest_start) * mean_side_);
  if (motion == Motion::teleport) {
    places_.resize(start_.size());
    std::iota(places_.begin(), places_.end(), 0u);
  }
}

MovingBoxes::MovingBoxes(std::vector<Aabb> boxes, Brownian motion, std::uint64_t seed)
    : MovingBoxes(std::move(boxes), Motion::brown, seed) {
  step_ = motion.step;
  std::erase_if(moved_, [&](std::uint32_t) { return random_.unit() >= motion.share; });
}

void MovingBoxes::next_frame() {
  switch (motion_) {
    case Motion::brown:
    case Motion::static5:
    case Motion::one:
      for (const std::uint32_t i : moved_) step(i);
      break;
    case Motion::fall:
      fall();
      break;
    case Motion::teleport:
      teleport();
      break;
    case Motion::tremble:
      tremble();
      break;
    case Motion::asleep:
      break;
  }
}

// Always from where the box started, so that its size does not change by rounding again and again.
void MovingBoxes::place(std::size_t i, const double (&offset)[3]) {
  for (int d = 0; d < 3; ++d) {
    boxes_[i].min[d] = static_cast<float>(static_cast<double>(start_[i].min[d]) + offset[d]);
    boxes_[i].max[d] = static_cast<float>(static_cast<double>(start_[i].max[d]) + offset[d]);
  }
}

void MovingBoxes::step(std::uint32_t i) {
  double offset[3];
  for (std::size_t d = 0; d < 3; ++d) {
    const double side = static_cast<double>(start_[i].max[d]) - static_cast<double>(start_[i].min[d]);
    offset[d] = offsets_[3 * i + d] += random_.real(-step_, step_) * side;
  }
  place(i, offset);
}

void MovingBoxes::tremble() {
  for (std::size_t i = 0; i < start_.size(); ++i) {
    double offset[3];
    for (int d = 0; d < 3; ++d)
      offset[d] = random_.real(-trembling, trembling) *
                  (static_cast<double>(start_[i].max[d]) - static_cast<double>(start_[i].min[d]));
    place(i, offset);
  }
}

void MovingBoxes::fall() {
  for (std::size_t i = 0; i < start_.size(); ++i) {
    speeds_[i] += acceleration * mean_side_;
    place(i, {0, offsets_[3 * i + 1] -= speeds_[i], 0});
  }
}

void MovingBoxes::teleport() {
  random_.shuffle(places_);
  for (std::size_t i = 0; i < start_.size(); ++i) {
    double offset[3];
    for (int d = 0; d < 3; ++d)
      offset[d] = static_cast<double>(start_[places_[i]].min[d]) - static_cast<double>(start_[i].min[d]);
    place(i, offset);
  }
}

}  // namespace boxstream::bench
