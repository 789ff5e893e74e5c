// SPDX-License-Identifier: MIT
#include "pictures/viewer/crowd.hpp"

#include <algorithm>
#include <cmath>

namespace boxstream::view {
namespace {

constexpr std::size_t one_astray_in = 100;
// Boxes without an end reach further.
constexpr float far_away = 1e15F;

bool has_end(const Snapshot::Box& box) {
  for (std::size_t d = 0; d < 3; ++d)
    if (!(box.min[d] <= box.max[d] && box.min[d] > -far_away && box.max[d] < far_away)) return false;
  return true;
}

std::vector<Snapshot::Box> boxes_of(const Snapshot& snapshot, bool all) {
  std::vector<Snapshot::Box> boxes;
  for (std::size_t i = 0; i < snapshot.boxes.size(); ++i)
    if ((all || snapshot.moods[i] != Mood::fixed) && has_end(snapshot.boxes[i])) boxes.push_back(snapshot.boxes[i]);
  return boxes;
}

/// The value that `rank` of `values` are below.
float ranked(std::vector<float>& values, std::size_t rank) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

Snapshot::Box crowd_of(const Snapshot& snapshot) {
  std::vector<Snapshot::Box> boxes = boxes_of(snapshot, false);
  if (boxes.empty()) boxes = boxes_of(snapshot, true);
  if (boxes.empty()) return {{-1, -1, -1}, {1, 1, 1}};
  const std::size_t astray = boxes.size() / one_astray_in;
  Snapshot::Box crowd;
  std::vector<float> values(boxes.size());
  for (std::size_t d = 0; d < 3; ++d) {
    std::transform(boxes.begin(), boxes.end(), values.begin(), [d](const auto& box) { return box.min[d]; });
    crowd.min[d] = ranked(values, astray);
    std::transform(boxes.begin(), boxes.end(), values.begin(), [d](const auto& box) { return box.max[d]; });
    crowd.max[d] = ranked(values, boxes.size() - 1 - astray);
  }
  return crowd;
}

Point first_eye(const Snapshot::Box& crowd) {
  // A window that is half as wide again as it is high has the camera about so far away, in diagonals of a cube.
  constexpr double away = 1.4;
  double diagonal = 0, length = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    diagonal = std::hypot(diagonal, static_cast<double>(crowd.max[d]) - crowd.min[d]);
    length = std::hypot(length, double{first_direction[d]});
  }
  Point eye;
  for (std::size_t d = 0; d < 3; ++d) {
    const double middle = (static_cast<double>(crowd.min[d]) + crowd.max[d]) / 2;
    eye[d] = static_cast<float>(middle + away * diagonal * first_direction[d] / length);
  }
  return eye;
}

}  // namespace boxstream::view
