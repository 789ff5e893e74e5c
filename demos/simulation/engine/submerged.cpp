// SPDX-License-Identifier: MIT
#include "simulation/engine/submerged.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "simulation/engine/convert.hpp"

namespace boxstream::scenes {
namespace {

using std::numbers::pi;

/// y in the world, from the world's origin, of a point of a body.
double height(const btTransform& body, const Vec3& v) {
  const btVector3& row = body.getBasis()[1];
  return row.x() * v[0] + row.y() * v[1] + row.z() * v[2] + body.getOrigin().y();
}

Vec3 turned(const btTransform& body, const Vec3& v) {
  const btMatrix3x3& m = body.getBasis();
  const auto row = [&](int r) { return m[r].x() * v[0] + m[r].y() * v[1] + m[r].z() * v[2]; };
  return {row(0), row(1), row(2)};
}

class Ball final : public Submersible {
 public:
  Ball(const Vec3& middle, double radius)
      : Submersible({4 * pi / 3 * radius * radius * radius, times(middle, 4 * pi / 3 * radius * radius * radius)},
                    middle, radius),
        middle_(middle),
        radius_(radius) {}

 private:
  Volume cut(const btTransform& body, double level) const override {
    const double r = radius_;
    const double t = std::clamp(level - height(body, middle_), -r, r);
    Volume result;
    result.add(pi * (r * r * (t + r) - (t * t * t + r * r * r) / 3), turned(body, middle_));
    result.moment[1] -= pi / 4 * (r * r - t * t) * (r * r - t * t);
    return result;
  }

  Vec3 middle_;
  double radius_;
};

/// Boxes and hulls: tetrahedra from a point at the level to each triangle, cut there. What closes the cut lies in a
/// plane with that point and adds nothing.
class Polyhedron final : public Submersible {
 public:
  Polyhedron(const Facets& facets, const Vec3& middle, double reach)
      : Submersible(whole(facets), middle, reach), triangles_(facets.triangles), lifted_(facets.vertices.size()) {
    for (const btVector3& v : facets.vertices) vertices_.push_back(exact(v));
  }

 private:
  static void add_tetrahedron(Volume& sum, const Vec3& a, const Vec3& b, const Vec3& c) {
    const double six =
        a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    sum.size += six;
    for (std::size_t d = 0; d < 3; ++d) sum.moment[d] += six * (a[d] + b[d] + c[d]);
  }
  static Volume scaled(Volume sum) {
    sum.size /= 6;
    sum.moment = times(sum.moment, 1.0 / 24);
    return sum;
  }
  static Volume whole(const Facets& facets) {
    Volume sum;
    const auto at = [&](std::uint32_t i) { return exact(facets.vertices[i]); };
    for (const auto& t : facets.triangles) add_tetrahedron(sum, at(t[0]), at(t[1]), at(t[2]));
    return scaled(sum);
  }
  /// Where the edge from `a`, below, to `b`, not below, meets the level.
  static Vec3 at_level(const Vec3& a, const Vec3& b) {
    const double share = a[1] / (a[1] - b[1]);
    return {a[0] + share * (b[0] - a[0]), 0, a[2] + share * (b[2] - a[2])};
  }

  Volume cut(const btTransform& body, double level) const override {
    // From a point at the level, over or under the body's origin.
    const double depth = level - body.getOrigin().y();
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      lifted_[i] = turned(body, vertices_[i]);
      lifted_[i][1] -= depth;
    }
    Volume sum;
    for (const auto& t : triangles_) {
      const Vec3* corner[3] = {&lifted_[t[0]], &lifted_[t[1]], &lifted_[t[2]]};
      const int below = ((*corner[0])[1] < 0) + ((*corner[1])[1] < 0) + ((*corner[2])[1] < 0);
      if (below == 0) continue;
      if (below == 3) {
        add_tetrahedron(sum, *corner[0], *corner[1], *corner[2]);
        continue;
      }
      // The one that is alone on its side comes first.
      while (((*corner[0])[1] < 0) != (below == 1)) std::rotate(corner, corner + 1, corner + 3);
      if (below == 1) {
        add_tetrahedron(sum, *corner[0], at_level(*corner[0], *corner[1]), at_level(*corner[0], *corner[2]));
      } else {
        const Vec3 left = at_level(*corner[1], *corner[0]), right = at_level(*corner[2], *corner[0]);
        add_tetrahedron(sum, left, *corner[1], *corner[2]);
        add_tetrahedron(sum, left, *corner[2], right);
      }
    }
    Volume result = scaled(sum);
    result.moment[1] += result.size * depth;
    return result;
  }

  std::vector<Vec3> vertices_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  mutable std::vector<Vec3> lifted_;  // scratch
};

/// A piece of a solid of revolution: the square of the radius at s along the axis is a polynomial.
struct Piece {
  double from, to;
  std::array<double, 3> square;  // of 1, s, s^2

  double square_at(double s) const { return square[0] + s * (square[1] + s * square[2]); }
  /// Area of all slices between two places, and their moment along the axis.
  std::array<double, 2> whole(double low, double high) const {
    double size = 0, moment = 0, a = low, b = high;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto n = static_cast<double>(k);
      size += square[k] * (b - a) / (n + 1);
      a *= low, b *= high;
      moment += square[k] * (b - a) / (n + 2);
    }
    return {pi * size, pi * moment};
  }
};

/// Cylinders, cones and capsules.
class Turned final : public Submersible {
 public:
  Turned(const std::vector<Piece>& pieces, const Vec3& middle, const Vec3& axis, double reach)
      : Submersible(whole(pieces, middle, axis), middle, reach), pieces_(pieces), middle_(middle), axis_(axis) {}

 private:
  static Volume along(const Vec3& middle, const Vec3& axis, double size, double moment) {
    Volume result;
    result.add(size, middle);
    for (std::size_t d = 0; d < 3; ++d) result.moment[d] += moment * axis[d];
    return result;
  }
  static Volume whole(const std::vector<Piece>& pieces, const Vec3& middle, const Vec3& axis) {
    double size = 0, moment = 0;
    for (const Piece& piece : pieces) {
      const auto [s, m] = piece.whole(piece.from, piece.to);
      size += s, moment += m;
    }
    return along(middle, axis, size, moment);
  }

  Volume cut(const btTransform& body, double level) const override {
    const Vec3 axis = turned(body, axis_);
    // In a slice the level is a line, `distance` + s * `slope` from the axis; upright bodies nearly have none.
    const double lean = std::max(std::sqrt(std::max(1 - axis[1] * axis[1], 0.0)), 1e-6);
    const double distance = (level - height(body, middle_)) / lean, slope = -axis[1] / lean;
    double size = 0, moment = 0, aside = 0;
    for (const Piece& piece : pieces_) {
      // Where the line touches the slice's circle, partly submerged slices begin or end.
      const double a = piece.square[2] - slope * slope, b = piece.square[1] - 2 * distance * slope,
                   c = piece.square[0] - distance * distance;
      std::array<double, 4> ends{piece.from, piece.from, piece.to, piece.to};
      if (const double root = b * b - 4 * a * c; root > 0 && a != 0) {
        const double q = -(b + std::copysign(std::sqrt(root), b)) / 2;
        ends[1] = std::clamp(q / a, piece.from, piece.to);
        ends[2] = std::clamp(q != 0 ? c / q : 0, piece.from, piece.to);
        if (ends[1] > ends[2]) std::swap(ends[1], ends[2]);
      }
      for (std::size_t i = 0; i < 3; ++i) {
        const double low = ends[i], high = ends[i + 1];
        if (!(high > low)) continue;
        const double s = (low + high) / 2, line = distance + s * slope;
        if (line * line < piece.square_at(s)) {
          add_partly(piece, low, high, distance, slope, size, moment, aside);
        } else if (line > 0) {
          const auto [whole_size, whole_moment] = piece.whole(low, high);
          size += whole_size, moment += whole_moment;
        }
      }
    }
    Volume result = along(turned(body, middle_), axis, size, moment);
    // Towards what is down in a slice.
    for (std::size_t d = 0; d < 3; ++d) result.moment[d] -= aside * ((d == 1 ? 1 : 0) - axis[1] * axis[d]) / lean;
    return result;
  }

  /// Segments of circles, by Gauss's rule of six points.
  static void add_partly(const Piece& piece, double low, double high, double distance, double slope, double& size,
                         double& moment, double& aside) {
    constexpr std::array<double, 3> places{0.2386191860831969, 0.6612093864662645, 0.9324695142031521};
    constexpr std::array<double, 3> weights{0.4679139345726910, 0.3607615730481386, 0.1713244923791704};
    const double half = (high - low) / 2, mean = (high + low) / 2;
    for (std::size_t k = 0; k < 6; ++k) {
      const double s = mean + (k < 3 ? half : -half) * places[k % 3];
      const double square = piece.square_at(s);
      if (!(square > 0)) continue;
      const double radius = std::sqrt(square), line = std::clamp((distance + s * slope) / radius, -1.0, 1.0);
      const double chord = std::sqrt(1 - line * line);
      const double area = square * (std::acos(-line) + line * chord) * half * weights[k % 3];
      size += area;
      moment += area * s;
      aside += 2.0 / 3 * square * radius * chord * chord * chord * half * weights[k % 3];
    }
  }

  std::vector<Piece> pieces_;
  Vec3 middle_, axis_;
};

std::unique_ptr<Submersible> submersible(const SolidPart& part) {
  const Vec3 middle = exact(part.pose.getOrigin()), axis = exact(part.pose.getBasis().getColumn(1));
  const double size = reach(part);
  const auto of = [&]<class S>(const S& s) -> std::unique_ptr<Submersible> {
    if constexpr (std::is_same_v<S, SphereShape>) {
      return std::make_unique<Ball>(middle, s.radius);
    } else if constexpr (std::is_same_v<S, CylinderShape>) {
      return std::make_unique<Turned>(std::vector<Piece>{{-s.height / 2, s.height / 2, {s.radius * s.radius, 0, 0}}},
                                      middle, axis, size);
    } else if constexpr (std::is_same_v<S, ConeShape>) {
      // The tip is at the upper end.
      const double share = s.radius * s.radius / (s.height * s.height);
      return std::make_unique<Turned>(
          std::vector<Piece>{
              {-s.height / 2, s.height / 2, {share * s.height * s.height / 4, -share * s.height, share}}},
          middle, axis, size);
    } else if constexpr (std::is_same_v<S, CapsuleShape>) {
      const double r = s.radius, h = s.height / 2;
      return std::make_unique<Turned>(std::vector<Piece>{{-h - r, -h, {r * r - h * h, -2 * h, -1}},
                                                         {-h, h, {r * r, 0, 0}},
                                                         {h, h + r, {r * r - h * h, 2 * h, -1}}},
                                      middle, axis, size);
    } else {
      return std::make_unique<Polyhedron>(facets(part), middle, size);
    }
  };
  return std::visit(of, *part.shape);
}

}  // namespace

Volume Submersible::below(const btTransform& body, double level) const {
  const double depth = level - height(body, middle_);
  if (depth <= -reach_) return {};
  if (depth >= reach_) return {whole_.size, turned(body, whole_.moment)};
  return cut(body, level);
}

Displacement::Displacement(ShapeSet& shapes, std::size_t shape, const btTransform& frame) {
  for (const SolidPart& part : solid_parts(shapes, shape, frame)) {
    parts_.push_back(submersible(part));
    volume_ += parts_.back()->volume();
  }
}

Volume Displacement::below(const btTransform& body, double level) const {
  Volume sum;
  for (const auto& part : parts_) {
    const Volume under = part->below(body, level);
    sum.size += under.size;
    for (std::size_t d = 0; d < 3; ++d) sum.moment[d] += under.moment[d];
  }
  return sum;
}

}  // namespace boxstream::scenes
