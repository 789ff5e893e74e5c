// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "local_minimum.hpp"

namespace boxstream::ccd {

/// A polytope inside A - B (cores) that grows where it is nearest to the origin: van den Bergen's expanding polytope
/// algorithm. Once it contains the origin, the distance of its nearest face is a lower bound of the minimum
/// translation. Each support point gives an upper bound. The bounds converge fast, except where A - B is curved near
/// the origin: there the gap closes only with the square of the number of points.
class Polytope {
 public:
  /// Starts with a tetrahedron. Where A - B is flat there is none, and its width is the minimum translation.
  explicit Polytope(const ShapePair& pair);

  /// Adds a separating translation that is known already.
  void add_known(double width, const Vec& direction);
  /// Grows until the bounds are within the tolerance, or up to a number of support points, or to the limit of
  /// precision.
  void grow(int most_points);
  /// The shortest separating translation found, `width` along `direction`.
  double width() const { return width_; }
  const Vec& direction() const { return direction_; }
  /// Lower bound of the minimum translation; minus infinity while the origin is outside.
  double least() const { return least_; }
  /// True if the number of points was the limit.
  bool limit() const { return limit_; }
  /// All separating translations found.
  const std::vector<std::pair<double, Vec>>& translations() const { return translations_; }

 private:
  struct Face {
    std::array<int, 3> corner;
    std::array<int, 3> beside;  ///< beside[i] shares the edge from corner[i] to the next one
    Vec normal;
    double height;  ///< of its plane over the origin
    bool removed;
  };
  struct Edge {
    int from;
    int to;
    int beyond;  ///< the face that remains
  };

  Face& face(int i) { return faces_[static_cast<std::size_t>(i)]; }
  const Vec& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  Vec support(const Vec& unit);
  Vec farther_of_both(const Vec& unit, const Vec& from);
  bool start();
  bool add_face(const std::array<int, 3>& corner, const std::array<int, 3>& beside);
  bool find_horizon(const Vec& point, int from);
  bool order_horizon();
  bool add(const Vec& point, int above);
  int lowest();

  const ShapePair& pair_;
  std::vector<std::pair<double, Vec>> translations_;
  std::vector<Vec> points_;
  std::vector<Face> faces_;
  std::vector<std::pair<double, int>> by_height_;  ///< a heap, lowest first; removed faces stay until popped
  std::vector<int> seen_;                          ///< faces that the point to be added lies beyond
  std::vector<Edge> horizon_;
  double width_ = std::numeric_limits<double>::infinity();
  Vec direction_ = Vec::Zero();
  double least_ = -std::numeric_limits<double>::infinity();
  bool limit_ = false;
  bool stuck_ = true;  ///< at the limit of precision, or not started
};

}  // namespace boxstream::ccd
