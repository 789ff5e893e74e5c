// SPDX-License-Identifier: MIT
#include "papers/experiments/workload.hpp"

#include <algorithm>

#include "inputs/random.hpp"

namespace boxstream::papers {

namespace {

using batches::Random;

Aabb bounds_of(const std::vector<Aabb>& boxes) {
  Aabb all = boxes.front();
  for (const Aabb& box : boxes) all = merged(all, box);
  return all;
}

double point_in(const Aabb& box, int d, Random& random) {
  return random.real(double{box.min[d]}, double{box.max[d]});
}

double side(const Aabb& box, int d) {
  return double{box.max[d]} - double{box.min[d]};
}

/// A number below `count`.
std::size_t any(std::size_t count, Random& random) {
  return static_cast<std::size_t>(random.integer(0, static_cast<std::int64_t>(count) - 1));
}

}  // namespace

std::vector<Aabb> queries_about(const std::vector<Aabb>& boxes, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Aabb> queries(count);
  for (Aabb& query : queries) {
    const Aabb& shape = boxes[any(boxes.size(), random)];
    const Aabb& place = boxes[any(boxes.size(), random)];
    for (int d = 0; d < 3; ++d) {
      const double middle = point_in(place, d, random), half = 0.75 * side(shape, d);
      query.min[d] = static_cast<float>(middle - half);
      query.max[d] = static_cast<float>(middle + half);
    }
  }
  return queries;
}

std::vector<Ray> rays_through(const std::vector<Aabb>& boxes, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  const Aabb all = bounds_of(boxes);
  std::vector<Ray> rays;
  for (std::size_t i = 0; i < count; ++i) {
    float origin[3], direction[3];
    for (int d = 0; d < 3; ++d) {
      origin[d] = static_cast<float>(point_in(all, d, random));
      direction[d] = static_cast<float>(point_in(all, d, random) - double{origin[d]});
    }
    rays.push_back(Ray::along(origin, direction, 1.0F));
  }
  return rays;
}

std::vector<Aabb> centres(const std::vector<Aabb>& boxes) {
  std::vector<Aabb> points = boxes;
  for (Aabb& point : points)
    for (int d = 0; d < 3; ++d)
      point.min[d] = point.max[d] = static_cast<float>(0.5 * (double{point.min[d]} + double{point.max[d]}));
  return points;
}

std::vector<std::vector<Aabb>> frames_of(const std::vector<Aabb>& boxes, std::size_t count, double share,
                                         std::uint64_t seed) {
  Random random(seed);
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (random.unit() < share) moving.push_back(i);
  std::vector<std::vector<Aabb>> frames;
  std::vector<Aabb> now = boxes;
  for (std::size_t frame = 0; frame < count; ++frame) {
    for (const std::size_t i : moving)
      for (int d = 0; d < 3; ++d) {
        const double offset = random.real(-0.1, 0.1) * side(boxes[i], d);
        now[i].min[d] = static_cast<float>(double{now[i].min[d]} + offset);
        now[i].max[d] = std::max(now[i].min[d], static_cast<float>(double{now[i].max[d]} + offset));
      }
    frames.push_back(now);
  }
  return frames;
}

}  // namespace boxstream::papers
