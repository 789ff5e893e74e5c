// SPDX-License-Identifier: MIT
#include "simulation/engine/hull_width.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include <LinearMath/btConvexHullComputer.h>

#include "formats/geometry/frame.hpp"

namespace boxstream::scenes {
namespace {

using Edge = btConvexHullComputer::Edge;
using geometry::cross, geometry::dot, geometry::minus, geometry::plus;

// Pairs of edges are compared: a hull with many corners is replaced by one inside of it, which is no wider.
constexpr std::size_t most_corners = 128;

/// Of the points, those that are the farthest in directions spread evenly over the sphere.
std::vector<Vec3> some_corners(const std::vector<Vec3>& points) {
  std::vector<Vec3> corners;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  for (std::size_t i = 0; i < most_corners; ++i) {
    const double z = (2 * static_cast<double>(i) + 1) / most_corners - 1, r = std::sqrt(1 - z * z);
    const double angle = golden_angle * static_cast<double>(i);
    const Vec3 way{r * std::cos(angle), r * std::sin(angle), z};
    corners.push_back(*std::max_element(points.begin(), points.end(),
                                        [&](const Vec3& a, const Vec3& b) { return dot(a, way) < dot(b, way); }));
  }
  return corners;
}

class Hull {
 public:
  explicit Hull(const std::vector<Vec3>& points) {
    computer_.compute(points[0].data(), sizeof(Vec3), static_cast<int>(points.size()), 0, 0);
    face_of_edge_.resize(static_cast<std::size_t>(computer_.edges.size()));
    for (int face = 0; face < computer_.faces.size(); ++face) add_face(computer_.edges[computer_.faces[face]]);
  }

  bool is_flat() const { return normals_.size() < 4; }

  /// The planes of the narrowest place lie on a face and a corner, or on two edges.
  double width() const {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& normal : normals_) least = std::min(least, extent(normal));
    std::vector<Side> sides;
    for (int i = 0; i < computer_.edges.size(); ++i)
      if (&computer_.edges[i] < computer_.edges[i].getReverseEdge()) sides.push_back(side(computer_.edges[i]));
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t k = i + 1; k < sides.size(); ++k)
        if (are_opposite(sides[i], sides[k])) least = std::min(least, distance(sides[i], sides[k]));
    return least;
  }

 private:
  /// An edge, and the normals of the two faces that meet there.
  struct Side {
    Vec3 at, along, left, right;
  };

  Vec3 corner(int vertex) const {
    const btVector3& p = computer_.vertices[vertex];
    return {double{p.x()}, double{p.y()}, double{p.z()}};
  }

  std::size_t index(const Edge& edge) const { return static_cast<std::size_t>(&edge - &computer_.edges[0]); }

  void add_face(const Edge& first) {
    const Vec3 apex = corner(first.getSourceVertex());
    Vec3 area{};
    const Edge* edge = &first;
    do {
      face_of_edge_[index(*edge)] = normals_.size();
      area =
          plus(area, cross(minus(corner(edge->getSourceVertex()), apex), minus(corner(edge->getTargetVertex()), apex)));
      edge = edge->getNextEdgeOfFace();
    } while (edge != &first);
    normals_.push_back(times(area, 1 / std::sqrt(dot(area, area))));
  }

  Side side(const Edge& edge) const {
    const Vec3 at = corner(edge.getSourceVertex());
    return {at, minus(corner(edge.getTargetVertex()), at), normals_[face_of_edge_[index(edge)]],
            normals_[face_of_edge_[index(*edge.getReverseEdge())]]};
  }

  double extent(const Vec3& normal) const {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i < computer_.vertices.size(); ++i) {
      const double at = dot(corner(i), normal);
      low = std::min(low, at), high = std::max(high, at);
    }
    return high - low;
  }

  /// Whether parallel planes through two edges have the hull between them: the normals of planes that touch it at one
  /// edge are an arc on the sphere, and it crosses the arc of those that touch it at the other, turned round.
  static bool are_opposite(const Side& a, const Side& b) {
    const Vec3 way_a = cross(a.right, a.left), way_b = cross(b.right, b.left);
    const double left_a = -dot(b.left, way_a), right_a = -dot(b.right, way_a);
    const double left_b = dot(a.left, way_b), right_b = dot(a.right, way_b);
    return left_a * right_a < 0 && left_b * right_b < 0 && left_a * right_b > 0;
  }

  static double distance(const Side& a, const Side& b) {
    const Vec3 normal = cross(a.along, b.along);
    return std::abs(dot(normal, minus(b.at, a.at))) / std::sqrt(dot(normal, normal));
  }

  btConvexHullComputer computer_;
  std::vector<Vec3> normals_;  // of the faces, outwards
  std::vector<std::size_t> face_of_edge_;
};

}  // namespace

double hull_width(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 low = points[0], high = points[0];
  for (const Vec3& p : points)
    for (std::size_t d = 0; d < 3; ++d) low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  // Bullet computes in float: far from the origin, nothing would be left of a small thing.
  const Vec3 centre = times(plus(low, high), 0.5);
  std::vector<Vec3> local = points.size() > most_corners ? some_corners(points) : points;
  for (Vec3& p : local) p = minus(p, centre);
  const Hull hull(local);
  if (hull.is_flat()) return 0;
  // btConvexHullComputer moves points by up to one cell of a lattice that has 10216 of them along each extent.
  const Vec3 size = minus(high, low);
  return std::max(0.0, hull.width() - 2 * std::sqrt(dot(size, size)) / 10216);
}

}  // namespace boxstream::scenes
