// SPDX-License-Identifier: MIT
#include "simulation/engine/contacts/separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace boxstream::scenes {
namespace {

/// A point of the difference of both shapes, and the point of b that it comes from.
struct Corner {
  Vec3 at, b;
};

Corner corner(const PlacedConvex& a, const PlacedConvex& b, const Vec3& direction) {
  const Vec3 of_b = b.support(times(direction, -1));
  return {minus(a.support(direction), of_b), of_b};
}

/// Corners of the difference, and the point of their hull that is nearest to the origin.
struct Simplex {
  std::array<Corner, 4> corners;
  std::array<double, 4> weights{};
  std::size_t count = 0;
  Vec3 nearest{};

  Vec3 on_b() const {
    Vec3 sum{};
    for (std::size_t i = 0; i < count; ++i) sum = plus(sum, times(corners[i].b, weights[i]));
    return sum;
  }

  /// Leaves those corners that the nearest point is made of.
  void reduce() {
    if (count == 4)
      nearest_of_tetrahedron();
    else
      nearest_of(count);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if (!(weights[i] > 0)) continue;
      corners[kept] = corners[i];
      weights[kept++] = weights[i];
    }
    count = kept;
  }

 private:
  void nearest_of(std::size_t corners_used) {
    if (corners_used == 1) {
      weights[0] = 1;
      nearest = corners[0].at;
    } else if (corners_used == 2) {
      nearest_of_segment();
    } else {
      nearest_of_triangle({0, 1, 2});
    }
  }

  void nearest_of_segment() {
    const Vec3 way = minus(corners[1].at, corners[0].at);
    const double whole = dot(way, way);
    const double t = whole > 0 ? std::clamp(-dot(corners[0].at, way) / whole, 0.0, 1.0) : 0;
    weights = {1 - t, t, 0, 0};
    nearest = plus(corners[0].at, times(way, t));
  }

  /// By the regions of a triangle's corners, sides and inside. Sets the weights of the three alone.
  double nearest_of_triangle(const std::array<std::size_t, 3>& of) {
    const Vec3 &a = corners[of[0]].at, &b = corners[of[1]].at, &c = corners[of[2]].at;
    const Vec3 ab = minus(b, a), ac = minus(c, a);
    std::array<double, 3> w{};
    const double d1 = -dot(ab, a), d2 = -dot(ac, a), d3 = -dot(ab, b), d4 = -dot(ac, b), d5 = -dot(ab, c),
                 d6 = -dot(ac, c);
    const double va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (d1 <= 0 && d2 <= 0) {
      w = {1, 0, 0};
    } else if (d3 >= 0 && d4 <= d3) {
      w = {0, 1, 0};
    } else if (d6 >= 0 && d5 <= d6) {
      w = {0, 0, 1};
    } else if (vc <= 0 && d1 >= 0 && d3 <= 0) {
      const double t = d1 / (d1 - d3);
      w = {1 - t, t, 0};
    } else if (vb <= 0 && d2 >= 0 && d6 <= 0) {
      const double t = d2 / (d2 - d6);
      w = {1 - t, 0, t};
    } else if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
      const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
      w = {0, 1 - t, t};
    } else {
      const double whole = va + vb + vc;
      w = {va / whole, vb / whole, vc / whole};
    }
    weights = {};
    for (std::size_t i = 0; i < 3; ++i) weights[of[i]] = w[i];
    nearest = plus(plus(times(a, w[0]), times(b, w[1])), times(c, w[2]));
    return dot(nearest, nearest);
  }

  /// The nearest face that the origin is outside of; the origin itself if it is outside of none.
  void nearest_of_tetrahedron() {
    constexpr std::array<std::array<std::size_t, 4>, 4> faces{{{0, 1, 2, 3}, {0, 3, 1, 2}, {0, 2, 3, 1}, {1, 3, 2, 0}}};
    double least = std::numeric_limits<double>::infinity();
    std::array<double, 4> best{};
    Vec3 at{};
    for (const auto& [i, j, k, opposite] : faces) {
      const Vec3& base = corners[i].at;
      const Vec3 n = cross(minus(corners[j].at, base), minus(corners[k].at, base));
      const double inside = dot(n, minus(corners[opposite].at, base)), origin = -dot(n, base);
      if (inside * origin > 0) continue;
      if (const double square = nearest_of_triangle({i, j, k}); square < least)
        least = square, best = weights, at = nearest;
    }
    if (std::isinf(least)) {
      weights = {0.25, 0.25, 0.25, 0.25};
      nearest = {};
    } else {
      weights = best, nearest = at;
    }
  }
};

/// The difference of two shapes that overlap, or touch, as a polyhedron that grows in the direction in which its
/// surface is nearest to the origin, until that is the surface of the difference.
class Growing {
 public:
  Growing(const PlacedConvex& a, const PlacedConvex& b)
      : a_(a),
        b_(b),
        size_(std::min(a.size(), b.size())),
        noise_(1e-11 * (a.size() + b.size())),
        enough_(std::max(1e-9 * size_, 2 * noise_)) {}

  bool start() {
    add(corner(a_, b_, {1, 0, 0}));
    add_farthest([&](const Vec3& p) { return length(minus(p, at(0))); }, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}});
    const Vec3 along = minus(at(1), at(0));
    if (!(length(along) > 0)) return false;
    const Vec3 x = times(along, 1 / length(along));
    const Vec3 y = unit(cross(x, std::abs(x[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0})), z = cross(x, y);
    add_farthest([&](const Vec3& p) { return length(cross(x, minus(p, at(0)))); }, {{y, z, plus(y, z)}});
    const Vec3 normal = cross(along, minus(at(2), at(0)));
    if (!(length(normal) > 1e-12 * size_ * length(along))) return false;
    const Vec3 n = unit(normal);
    add_farthest([&](const Vec3& p) { return std::abs(dot(n, minus(p, at(0)))); }, {{n, plus(n, x), plus(n, y)}});
    const double height = dot(n, minus(at(3), at(0)));
    if (!(std::abs(height) > 1e-12 * size_)) return false;
    if (height > 0) std::swap(corners_[1], corners_[2]);
    for (std::size_t i = 0; i < 4; ++i) middle_ = plus(middle_, times(at(i), 0.25));
    add_face(0, 1, 2);
    add_face(0, 3, 1);
    add_face(0, 2, 3);
    add_face(1, 3, 2);
    return true;
  }

  /// Whatever happens, moving a out along the normal by the depth parts the two.
  Separation grow() {
    double least = std::numeric_limits<double>::infinity();
    Face best{};
    while (true) {
      const std::size_t nearest = nearest_face();
      const Face face = faces_[nearest];
      if (face.flat) break;
      const Corner next = corner(a_, b_, face.normal);
      const double depth = dot(face.normal, next.at);
      if (depth < least) {
        least = depth;
        best = face;
      }
      if (depth - face.offset <= enough_ || face.offset >= least || corner_count_ == most_corners ||
          !replace_seen(nearest, next))
        break;
    }
    return result(best, least);
  }

 private:
  static constexpr std::size_t most_corners = 128, most_faces = 512;

  struct Face {
    std::array<std::size_t, 3> corners;
    Vec3 normal;
    double offset;
    bool flat;  // without area, it has no normal
  };

  static Vec3 unit(const Vec3& v) { return times(v, 1 / length(v)); }
  const Vec3& at(std::size_t i) const { return corners_[i].at; }
  void add(const Corner& c) { corners_[corner_count_++] = c; }

  template <class Measure>
  void add_farthest(Measure measure, const std::array<Vec3, 3>& directions) {
    double most = -1;
    Corner best{};
    for (const Vec3& d : directions) {
      for (const double sign : {1.0, -1.0}) {
        const Corner c = corner(a_, b_, times(d, sign));
        if (const double far = measure(c.at); far > most) most = far, best = c;
      }
    }
    add(best);
  }

  void add_face(std::size_t i, std::size_t j, std::size_t k) {
    const Vec3 u = minus(at(j), at(i)), v = minus(at(k), at(i)), n = cross(u, v);
    const double area = length(n);
    Face face{{i, j, k}, {}, std::numeric_limits<double>::infinity(), true};
    if (area > 1e-13 * (dot(u, u) + dot(v, v))) {
      face.normal = times(n, 1 / area);
      face.offset = dot(face.normal, at(i));
      // One that looks inwards is a splinter, turned by rounding.
      face.flat = dot(face.normal, middle_) > face.offset;
      if (face.flat) face.offset = std::numeric_limits<double>::infinity();
    }
    faces_[face_count_++] = face;
  }

  std::size_t nearest_face() const {
    std::size_t best = 0;
    for (std::size_t i = 1; i < face_count_; ++i)
      if (faces_[i].offset < faces_[best].offset) best = i;
    return best;
  }

  std::size_t face_beyond(std::size_t from, std::size_t to) const {
    for (std::size_t f = 0; f < face_count_; ++f) {
      const auto& [x, y, z] = faces_[f].corners;
      if ((x == to && y == from) || (y == to && z == from) || (z == to && x == from)) return f;
    }
    return face_count_;
  }

  /// Takes out the faces that the corner sees, spreading from one of them, and joins it with the edge of the hole.
  bool replace_seen(std::size_t first, const Corner& next) {
    std::array<bool, most_faces> seen{};
    std::array<std::size_t, most_faces> open;
    std::array<std::array<std::size_t, 2>, most_faces> edges;
    std::size_t open_count = 0, edge_count = 0;
    seen[first] = true;
    open[open_count++] = first;
    while (open_count > 0) {
      const auto corners = faces_[open[--open_count]].corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t from = corners[i], to = corners[(i + 1) % 3], other = face_beyond(from, to);
        if (other == face_count_) return false;
        if (seen[other]) continue;
        const Face& face = faces_[other];
        if (face.flat || dot(face.normal, next.at) - face.offset > noise_) {
          seen[other] = true;
          open[open_count++] = other;
        }
      }
    }
    for (std::size_t f = 0; f < face_count_; ++f) {
      if (!seen[f]) continue;
      const auto& corners = faces_[f].corners;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t from = corners[i], to = corners[(i + 1) % 3];
        if (!seen[face_beyond(from, to)]) edges[edge_count++] = {from, to};
      }
    }
    std::size_t kept = 0;
    for (std::size_t f = 0; f < face_count_; ++f)
      if (!seen[f]) faces_[kept++] = faces_[f];
    face_count_ = kept;
    if (edge_count == 0 || face_count_ + edge_count > most_faces) return false;
    add(next);
    for (std::size_t e = 0; e < edge_count; ++e) add_face(edges[e][0], edges[e][1], corner_count_ - 1);
    return true;
  }

  Separation result(const Face& face, double depth) const {
    // Where the origin is above the face.
    Simplex simplex;
    simplex.count = 3;
    for (std::size_t i = 0; i < 3; ++i) simplex.corners[i] = corners_[face.corners[i]];
    simplex.reduce();
    return {-depth, times(face.normal, -1), simplex.on_b()};
  }

  const PlacedConvex &a_, &b_;
  double size_;
  double noise_;   // of heights above a face, which may be as narrow as the small shape and as long as the large one
  double enough_;  // for a face to be one of the difference
  Vec3 middle_{};  // of the first four corners: it stays inside
  std::array<Corner, most_corners> corners_;
  std::array<Face, most_faces> faces_;
  std::size_t corner_count_ = 0, face_count_ = 0;
};

Separation rounded(Separation core, const PlacedConvex& a, const PlacedConvex& b) {
  core.distance -= a.radius() + b.radius();
  core.on_b = plus(core.on_b, times(core.normal, b.radius()));
  return core;
}

}  // namespace

Separation separation(const PlacedConvex& a, const PlacedConvex& b, double reach) {
  const double size = std::min(a.size(), b.size()), near = 1e-9 * size;
  Simplex simplex;
  Vec3 nearest = minus(a.support({0, 1, 0}), b.support({0, -1, 0}));
  double square = std::numeric_limits<double>::infinity();
  bool converged = false;
  for (int round = 0; round < 64; ++round) {
    const Corner next = corner(a, b, times(nearest, -1));
    // A plane across `nearest` has the whole difference on its far side by so much.
    const double distance = length(nearest);
    const double along = distance > 0 ? dot(nearest, next.at) / distance : 0;
    if (along - a.radius() - b.radius() > reach)
      return {along - a.radius() - b.radius(), times(nearest, 1 / distance), next.b};
    converged = simplex.count > 0 && distance - along <= 1e-10 * std::max(distance, size);
    if (converged) break;
    const Simplex former = simplex;
    simplex.corners[simplex.count++] = next;
    simplex.reduce();
    const double now = dot(simplex.nearest, simplex.nearest);
    if (!(now < square)) {
      // No nearer within rounding, which is small where shapes are of one size.
      simplex = former;
      converged = simplex.count > 0 && distance - along <= 1e-6 * size;
      break;
    }
    square = now;
    nearest = simplex.nearest;
    if (now <= near * near) break;
  }
  if (converged && length(nearest) > near)
    return rounded({length(nearest), times(nearest, 1 / length(nearest)), simplex.on_b()}, a, b);
  Growing growing(a, b);
  // Two that have no volume between them, as capsules that cross: any way across is a way out.
  if (!growing.start()) return rounded({0, {0, 1, 0}, b.support({0, 1, 0})}, a, b);
  return rounded(growing.grow(), a, b);
}

}  // namespace boxstream::scenes
