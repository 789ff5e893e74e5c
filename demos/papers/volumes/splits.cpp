// SPDX-License-Identifier: MIT
#include "papers/volumes/splits.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdlib>
#include <limits>

#include "papers/volumes/axis_box.hpp"

namespace boxstream::papers::volumes {

namespace {

/// By the value of `key`, and of equals by number, so that the order is one.
template <class Key>
auto by(const Key& key) {
  return [&key](std::uint32_t a, std::uint32_t b) {
    const double ka = key(a), kb = key(b);
    return ka != kb ? ka < kb : a < b;
  };
}

template <class Key>
std::size_t halves(Span<std::uint32_t> objects, const Key& key) {
  const std::size_t half = objects.size() / 2;
  std::nth_element(objects.begin(), objects.begin() + half, objects.end(), by(key));
  return half;
}

std::vector<Point> centres_of(const Atoms& atoms, Span<std::uint32_t> objects) {
  std::vector<Point> centres;
  for (const std::uint32_t object : objects) centres.push_back(atoms.centres[object]);
  return centres;
}

template <class Measure>
std::size_t least_cost(const Atoms& atoms, Span<std::uint32_t> objects, const Measure& measure) {
  const std::size_t n = objects.size();
  const auto from_middle = [n](std::size_t j) { return std::abs(2 * static_cast<long>(j) - static_cast<long>(n)); };
  std::vector<std::uint32_t> order(objects.begin(), objects.end()), best_order;
  std::vector<double> left(n);
  double best = std::numeric_limits<double>::infinity();
  std::size_t best_j = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto centre = [&](std::uint32_t object) { return atoms.centres[object][axis]; };
    std::sort(order.begin(), order.end(), by(centre));
    Aabb64 box = atoms.boxes[order[0]];
    for (std::size_t j = 1; j < n; ++j) {
      left[j] = measure(box) * static_cast<double>(j);
      box = merged(box, atoms.boxes[order[j]]);
    }
    box = atoms.boxes[order[n - 1]];
    bool better = false;
    for (std::size_t j = n - 1; j > 0; --j) {
      const double cost = left[j] + measure(box) * static_cast<double>(n - j);
      if (cost < best || (cost == best && from_middle(j) < from_middle(best_j))) {
        best = cost;
        best_j = j;
        better = true;
      }
      box = merged(box, atoms.boxes[order[j - 1]]);
    }
    if (better) best_order = order;
  }
  std::copy(best_order.begin(), best_order.end(), objects.begin());
  return best_j;
}

}  // namespace

std::size_t split_at_median(const Atoms& atoms, Span<std::uint32_t> objects) {
  const std::vector<Point> centres = centres_of(atoms, objects);
  const Aabb64 box = AxisBox::around(centres).box;
  Eigen::Index axis = 0;
  (Point(box.max) - Point(box.min)).maxCoeff(&axis);
  return halves(objects, [&](std::uint32_t object) { return atoms.centres[object][axis]; });
}

std::size_t split_by_surface_area(const Atoms& atoms, Span<std::uint32_t> objects) {
  return least_cost(atoms, objects, [](const Aabb64& box) { return area(box); });
}

std::size_t split_by_volume(const Atoms& atoms, Span<std::uint32_t> objects) {
  return least_cost(atoms, objects, [](const Aabb64& box) { return volume(box); });
}

std::size_t split_across_principal_axis(const Atoms& atoms, Span<std::uint32_t> objects) {
  const PrincipalAxes principal = principal_axes(centres_of(atoms, objects));
  const Point axis = principal.axes.col(2);
  const auto along = [&](std::uint32_t object) { return axis.dot(atoms.centres[object] - principal.barycentre); };
  const auto middle = std::partition(objects.begin(), objects.end(), [&](std::uint32_t o) { return along(o) < 0; });
  if (middle == objects.begin() || middle == objects.end()) return halves(objects, along);
  return static_cast<std::size_t>(middle - objects.begin());
}

PrincipalAxes principal_axes(Points points) {
  Point sum = Point::Zero();
  for (const Point& p : points) sum += p;
  const Point barycentre = sum / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Point& p : points) covariance += (p - barycentre) * (p - barycentre).transpose();
  return {barycentre, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors()};
}

}  // namespace boxstream::papers::volumes
