// SPDX-License-Identifier: MIT
#include "simplex.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>

namespace boxstream::ccd {
namespace {

/// The best point found so far.
class Nearest {
 public:
  explicit Nearest(const Simplex& from) : from_(from) {}

  void try_vertex(int i) { offer({i}, {1}); }

  void try_segment(int i, int j) {
    const Vec edge = from_[j].w - from_[i].w;
    const double length2 = edge.squaredNorm();
    const double t = length2 > 0 ? -from_[i].w.dot(edge) / length2 : 0;
    if (!(t > 0)) return try_vertex(i);
    if (!(t < 1)) return try_vertex(j);
    offer({i, j}, {1 - t, t});
  }

  void try_triangle(int i, int j, int k) {
    try_segment(i, j);
    try_segment(j, k);
    try_segment(k, i);
    const Vec &p = from_[i].w, &q = from_[j].w, &r = from_[k].w;
    const Vec normal = (q - p).cross(r - p);
    const double u = normal.dot(q.cross(r)), v = normal.dot(r.cross(p)), w = normal.dot(p.cross(q));
    const double sum = u + v + w;
    if (u > 0 && v > 0 && w > 0 && std::isfinite(sum)) offer({i, j, k}, {u / sum, v / sum, w / sum});
  }

  /// True if the origin is inside.
  bool try_tetrahedron() {
    const Vec &p = from_[0].w, &q = from_[1].w, &r = from_[2].w, &s = from_[3].w;
    // Volumes of the four tetrahedra that the origin makes with the faces.
    const double a = q.dot(r.cross(s)), b = -p.dot(r.cross(s)), c = p.dot(q.cross(s)), d = -p.dot(q.cross(r));
    const double sum = a + b + c + d;
    const bool inside = (a > 0 && b > 0 && c > 0 && d > 0) || (a < 0 && b < 0 && c < 0 && d < 0);
    if (inside) {
      offer({0, 1, 2, 3}, {a / sum, b / sum, c / sum, d / sum}, 0);
      return true;
    }
    try_triangle(0, 1, 2);
    try_triangle(0, 1, 3);
    try_triangle(0, 2, 3);
    try_triangle(1, 2, 3);
    return false;
  }

  const Simplex& best() const { return best_; }

 private:
  void offer(std::initializer_list<int> vertices, std::initializer_list<double> weights, double at_distance2 = -1) {
    Simplex candidate;
    auto weight = weights.begin();
    for (const int i : vertices) {
      candidate.weight[static_cast<std::size_t>(candidate.size)] = *weight++;
      candidate.add(from_[i]);
    }
    const double distance2 = at_distance2 >= 0 ? at_distance2 : candidate.point().squaredNorm();
    if (!(distance2 < distance2_)) return;
    distance2_ = distance2;
    best_ = candidate;
  }

  const Simplex& from_;
  Simplex best_;
  double distance2_ = std::numeric_limits<double>::infinity();
};

}  // namespace

Vec Simplex::mix(Vec Vertex::*part) const {
  Vec sum = Vec::Zero();
  for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i) sum += weight[i] * (vertex[i].*part);
  return sum;
}

bool reduce_to_nearest(Simplex& simplex) {
  Nearest nearest(simplex);
  bool inside = false;
  switch (simplex.size) {
    case 1:
      nearest.try_vertex(0);
      break;
    case 2:
      nearest.try_segment(0, 1);
      break;
    case 3:
      nearest.try_triangle(0, 1, 2);
      break;
    default:
      inside = nearest.try_tetrahedron();
  }
  simplex = Simplex(nearest.best());
  return inside;
}

}  // namespace boxstream::ccd
