// SPDX-License-Identifier: MIT
#include "mesh/three_phases.hpp"

#include <algorithm>
#include <boxstream/detector.hpp>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "mesh/nearest_triangles.hpp"
#include "mesh/point_triangle.hpp"

namespace boxstream::mesh {
namespace {

/// A point is near if it is up to this many sides of the median cube away: then a cube around it meets some hundred
/// triangles, which takes about as long as to ask a tree once (measured). This number of rounds of phase II reaches
/// that far.
constexpr double sides_that_are_near = 4;
constexpr int rounds_that_are_near = 2;

/// Up to this number of points, comparing with all triangles takes less time than a tree of them.
constexpr std::size_t few_points = 32;

struct Cube {
  Vec3 centre;
  double half_side;
};

std::vector<Cube> cubes_around(const TriangleMesh& mesh) {
  std::vector<Cube> cubes;
  double largest = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = triangle_of(mesh, i);
    Cube cube{{}, 0};
    for (std::size_t d = 0; d < 3; ++d) {
      const auto [low, high] = std::minmax({t[0][d], t[1][d], t[2][d]});
      cube.centre[d] = low / 2 + high / 2;
      cube.half_side = std::max(cube.half_side, high / 2 - low / 2);
    }
    largest = std::max(largest, cube.half_side);
    cubes.push_back(cube);
  }
  // A triangle that is a point would never grow.
  constexpr double least_of_largest = 1e-6;
  for (Cube& cube : cubes) cube.half_side = std::max({cube.half_side, least_of_largest * largest, least_magnitude});
  return cubes;
}

class Phases {
 public:
  Phases(const std::vector<Vec3>& points, const TriangleMesh& mesh, BoxSearch search = {})
      : points_(points), nearest_(points.size()), search_(std::move(search)) {
    triangles_.reserve(mesh.triangles.size());
    boxes_.reserve(mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      triangles_.emplace_back(triangle_of(mesh, i));
      boxes_.push_back(box_of(triangle_of(mesh, i)));
    }
    cubes_ = cubes_around(mesh);
  }

  std::vector<Nearest> run(PhaseCounts& counts) {
    std::vector<std::uint32_t> rest = all_points();
    counts.first_pairs = estimate(rest);
    keep_those_without_estimate(rest);
    counts.late_points = rest.size();
    while (!rest.empty()) {
      double_cubes();
      counts.second_pairs += estimate(rest);
      keep_those_without_estimate(rest);
      ++counts.rounds;
    }
    counts.third_pairs = search_within_estimates(all_points());
    return std::move(nearest_);
  }

  /// The same for points that are near, by estimate. Returns the others.
  std::vector<std::uint32_t> run_for_near_points() {
    const double side = median_side();
    std::vector<std::uint32_t> rest = all_points();
    for (int round = 0; round <= rounds_that_are_near && !rest.empty(); ++round) {
      if (round > 0) double_cubes();
      estimate(rest);
      keep_those_without_estimate(rest);
    }
    const double reach = sides_that_are_near * side;
    std::vector<std::uint32_t> near, far;
    for (std::uint32_t i = 0; i < points_.size(); ++i) (nearest_[i].squared <= reach * reach ? near : far).push_back(i);
    search_within_estimates(near);
    return far;
  }

  void compare_with_all(std::uint32_t point) {
    for (std::uint32_t triangle = 0; triangle < triangles_.size(); ++triangle) compare(point, triangle);
  }

  std::vector<Nearest>& nearest() { return nearest_; }

 private:
  std::vector<std::uint32_t> all_points() const {
    std::vector<std::uint32_t> all(points_.size());
    std::iota(all.begin(), all.end(), 0u);
    return all;
  }

  double median_side() const {
    std::vector<double> sides;
    for (const Cube& cube : cubes_) sides.push_back(2 * cube.half_side);
    const auto middle = sides.begin() + static_cast<std::ptrdiff_t>(sides.size() / 2);
    std::nth_element(sides.begin(), middle, sides.end());
    return *middle;
  }

  void double_cubes() {
    for (Cube& cube : cubes_) cube.half_side *= 2;
  }

  std::uint64_t estimate(const std::vector<std::uint32_t>& numbers) {
    std::vector<Aabb> of_points, of_triangles;
    for (const std::uint32_t i : numbers) of_points.push_back(box_of(points_[i]));
    for (const Cube& cube : cubes_) of_triangles.push_back(box_of(cube.centre, cube.half_side));
    return compare_pairs(of_points, of_triangles, [&](std::uint32_t i) { return numbers[i]; });
  }

  std::uint64_t search_within_estimates(const std::vector<std::uint32_t>& numbers) {
    std::vector<Aabb> of_points;
    for (const std::uint32_t i : numbers) of_points.push_back(box_of(points_[i], std::sqrt(nearest_[i].squared)));
    return compare_pairs(of_points, boxes_, [&](std::uint32_t i) { return numbers[i]; });
  }

  /// Returns how many pairs there were. `number_of` gives the number of the point that a box belongs to.
  template <class NumberOf>
  std::uint64_t compare_pairs(const std::vector<Aabb>& of_points, const std::vector<Aabb>& of_triangles,
                              const NumberOf& number_of) {
    std::uint64_t count = 0;
    if (search_) {
      search_(of_points, of_triangles, [&](std::uint32_t a, std::uint32_t b) {
        ++count;
        compare(number_of(a), b);
      });
      return count;
    }
    detector_.stream_pairs(of_points, of_triangles, [&](Span<const Pair> pairs) {
      count += pairs.size();
      for (const Pair pair : pairs) compare(number_of(pair.a), pair.b);
      return true;
    });
    return count;
  }

  void compare(std::uint32_t point, std::uint32_t triangle) {
    Nearest& nearest = nearest_[point];
    const double squared = triangles_[triangle].squared(points_[point], nearest.squared);
    if (squared < nearest.squared) nearest = {squared, triangle};
  }

  void keep_those_without_estimate(std::vector<std::uint32_t>& numbers) const {
    numbers.erase(std::remove_if(numbers.begin(), numbers.end(),
                                 [&](std::uint32_t i) { return nearest_[i].triangle != Nearest::none; }),
                  numbers.end());
  }

  const std::vector<Vec3>& points_;
  std::vector<TriangleDistance> triangles_;
  std::vector<Aabb> boxes_;
  std::vector<Cube> cubes_;
  std::vector<Nearest> nearest_;
  BoxSearch search_;
  Detector detector_;
};

void check_both(const std::vector<Vec3>& points, const TriangleMesh& mesh) {
  check(points);
  check(mesh);
  if (mesh.triangles.empty()) throw std::invalid_argument("a mesh without triangles has no distance to anything");
}

}  // namespace

std::vector<Nearest> three_phase_distances(const std::vector<Vec3>& points, const TriangleMesh& mesh,
                                           PhaseCounts* counts, const BoxSearch& search) {
  check_both(points, mesh);
  PhaseCounts not_wanted;
  return Phases(points, mesh, search).run(counts ? *counts : not_wanted);
}

std::vector<Nearest> surface_distances(const std::vector<Vec3>& points, const TriangleMesh& mesh) {
  check_both(points, mesh);
  Phases phases(points, mesh);
  const std::vector<std::uint32_t> far = phases.run_for_near_points();
  if (far.size() <= few_points) {
    for (const std::uint32_t i : far) phases.compare_with_all(i);
    return std::move(phases.nearest());
  }
  const NearestTriangles triangles(mesh);
  std::uint32_t hint = Nearest::none;
  for (const std::uint32_t i : far) {
    phases.nearest()[i] = triangles.nearest(points[i], hint);
    hint = phases.nearest()[i].triangle;
  }
  return std::move(phases.nearest());
}

}  // namespace boxstream::mesh
