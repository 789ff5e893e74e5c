// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "inputs/recipe.hpp"

namespace boxstream::bench {

namespace {

using batches::Random;

struct Point {
  double x[3];
};

/// Makes the centres of one part, one after the other, in the unit cube.
class Centres {
 public:
  Centres(const Part& part, Random& random) : part_(part), random_(random) {
    if (part.place == Place::clusters)
      for (int i = 0; i < part.groups; ++i) clusters_.push_back(uniform());
  }

  Point next() {
    switch (part_.place) {
      case Place::uniform:
        return uniform();
      case Place::clusters:
        return around(clusters_[static_cast<std::size_t>(random_.integer(0, part_.groups - 1))]);
      case Place::shell:
        return on_shell();
      case Place::lattice:
        return on_lattice();
      case Place::diagonal: {
        const double t = random_.unit();
        return {t, t, t};
      }
      case Place::crossing: {
        const double t = random_.unit();
        return {t, 1 - t, t < 0.5 ? t : 1 - t};
      }
      case Place::point:
        break;
    }
    return {0.5, 0.5, 0.5};
  }

 private:
  Point uniform() { return {random_.unit(), random_.unit(), random_.unit()}; }

  Point around(Point centre) {
    const double spread = 0.1 / std::cbrt(part_.groups);
    for (double& x : centre.x) x += spread * random_.gaussian();
    return centre;
  }

  Point on_shell() {
    Point p;
    double square;
    do {
      square = 0;
      for (double& x : p.x) {
        x = random_.real(-1, 1);
        square += x * x;
      }
    } while (square > 1 || square < 0.01);
    for (double& x : p.x) x = 0.5 + 0.5 * x / std::sqrt(square);
    return p;
  }

  Point on_lattice() {
    Point p;
    for (double& x : p.x) x = static_cast<double>(random_.integer(0, part_.groups - 1)) / part_.groups;
    return p;
  }

  const Part& part_;
  Random& random_;
  std::vector<Point> clusters_;
};

struct Range {
  double low, high;
};

/// A piece of a line through the whole extent. Pieces share their ends unless these are moved.
Range piece_of(const Part& part, double extent, Random& random) {
  const double length = extent / part.pieces;
  const auto piece = static_cast<double>(random.integer(0, part.pieces - 1));
  const auto moved = [&](double end) {
    return part.jitter == 0 ? end : end + length * part.jitter * random.real(-0.5, 0.5);
  };
  const double low = moved(length * piece), high = moved(length * (piece + 1));
  return {std::min(low, high), std::max(low, high)};
}

/// How much smaller than the world the heap is that a box is in.
double shrunk(const Part& part, Random& random) {
  int level = 0;
  while (level < part.levels && random.unit() < 0.85) ++level;
  return std::pow(10, -part.shrink * level);
}

Aabb make_box(const Part& part, Centres& centres, Random& random) {
  const Point centre = centres.next();
  double luck = random.real(-0.5, 0.5);
  Aabb box;
  int along = 3;
  if (part.pieces > 0) along = random.unit() < part.lean ? 0 : static_cast<int>(random.integer(0, 2));
  const double scale = part.levels > 0 ? shrunk(part, random) : 1;
  for (int d = 0; d < 3; ++d) {
    if (!part.alike && d > 0) luck = random.real(-0.5, 0.5);
    const double half = 0.5 * std::pow(10, part.size[d] + part.decades * luck);
    double low = centre.x[d] * std::pow(10, part.extent[d]) - half, high = low + 2 * half;
    if (part.snap > 0) {
      low = part.snap * std::floor(low / part.snap);
      high = part.snap * std::floor(high / part.snap);
    }
    if (d == along) {
      const Range piece = piece_of(part, std::pow(10, part.extent[d]), random);
      low = piece.low;
      high = piece.high;
    }
    box.min[d] = static_cast<float>(scale * low);
    box.max[d] = static_cast<float>(scale * high);
  }
  return box;
}

}  // namespace

std::vector<Aabb> make_boxes(const Recipe& recipe) {
  std::vector<Aabb> boxes;
  Random random(recipe.seed);
  int weights = 0, before = 0;
  for (const Part& part : recipe.parts) weights += part.weight;
  for (const Part& part : recipe.parts) {
    before += part.weight;
    const std::size_t end = recipe.n * static_cast<std::size_t>(before) / static_cast<std::size_t>(weights);
    Centres centres(part, random);
    while (boxes.size() < end) {
      const Aabb box = make_box(part, centres, random);
      for (int copy = 0; copy < part.copies && boxes.size() < end; ++copy) boxes.push_back(box);
    }
  }
  const int axis = recipe.axis;
  if (recipe.order == Order::shuffled) random.shuffle(boxes);
  if (recipe.order == Order::ascending)
    std::stable_sort(boxes.begin(), boxes.end(),
                     [axis](const Aabb& a, const Aabb& b) { return a.min[axis] < b.min[axis]; });
  if (recipe.order == Order::descending)
    std::stable_sort(boxes.begin(), boxes.end(),
                     [axis](const Aabb& a, const Aabb& b) { return a.max[axis] > b.max[axis]; });
  return boxes;
}

}  // namespace boxstream::bench
