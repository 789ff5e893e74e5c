// SPDX-License-Identifier: MIT
#include "papers/experiments/disks.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "inputs/random.hpp"
#include "papers/experiments/rows.hpp"
#include "papers/thick/report_intersections.hpp"

namespace boxstream::papers {

namespace {

void run_thick(const std::vector<Ball>& balls, int dimensions, float distance, Found found, Pivot pivot) {
  const Span<const Ball> all(balls);
  if (dimensions == 2)
    thick_near_pairs<2>(all, distance, found, pivot);
  else
    thick_near_pairs<3>(all, distance, found, pivot);
}

}  // namespace

std::vector<Ball> make_balls(std::size_t n, int dimensions, double pairs, double factor, std::uint64_t seed) {
  batches::Random random(seed);
  std::vector<Ball> balls(n);
  std::vector<double> radii(n);
  double sum = 0, squares = 0, cubes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (int d = 0; d < dimensions; ++d) balls[i].centre[d] = static_cast<float>(random.unit());
    const double r = radii[i] = random.log_uniform(factor);
    sum += r;
    squares += r * r;
    cubes += r * r * r;
  }
  // Two with centres anywhere intersect with the probability of the mean area pi (r + s)^2, or volume, but for what is
  // outside; of two independent radii, that is the sum of the products of their moments.
  const double count = static_cast<double>(n), m1 = sum / count, m2 = squares / count, m3 = cubes / count;
  const double all_pairs = count * (count - 1) / 2, pi = 3.141592653589793;
  const double scale = dimensions == 2 ? std::sqrt(pairs / (all_pairs * pi * (2 * m2 + 2 * m1 * m1)))
                                       : std::cbrt(pairs / (all_pairs * 4 / 3 * pi * (2 * m3 + 6 * m2 * m1)));
  for (std::size_t i = 0; i < n; ++i) balls[i].radius = static_cast<float>(scale * radii[i]);
  return balls;
}

Contestant thick(const std::vector<Ball>& balls, int dimensions, float distance) {
  return {"thick", [=, &balls](Found found) { run_thick(balls, dimensions, distance, found, Pivot::median); }};
}

Contestant thick_at_random(const std::vector<Ball>& balls, int dimensions) {
  return {"thick, random pivot", [=, &balls](Found found) { run_thick(balls, dimensions, 0, found, Pivot::random); }};
}

Contestant engine(const std::vector<Ball>& balls, float distance) {
  const auto detector = std::make_shared<Detector>();
  stream_near_pairs(*detector, balls, distance, [](Span<const Pair>) { return true; });
  return {engine_name, [=, &balls](Found found) {
            stream_near_pairs(*detector, balls, distance, [&](Span<const Pair> pairs) {
              for (const Pair pair : pairs) found(pair.a, pair.b);
              return true;
            });
          }};
}

Contestant naive(const std::vector<Ball>& balls) {
  return {"naive", [&](Found found) {
            for (std::uint32_t i = 0; i < balls.size(); ++i)
              for (std::uint32_t j = i + 1; j < balls.size(); ++j)
                if (is_near(balls[i], balls[j], 0.0F)) found(i, j);
          }};
}

}  // namespace boxstream::papers
