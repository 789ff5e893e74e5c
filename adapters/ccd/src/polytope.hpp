// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <limits>
#include <utility>
#include <vector>

#include "downhill.hpp"

namespace boxstream::ccd {

/// A polytope inside A - B (cores) that grows where it is nearest to the origin: van den Bergen's expanding polytope
/// algorithm. Once it holds the origin, no way out is shorter than the distance of its nearest face; each direction
/// that it asks about gives a way out. The two meet soon, except where A - B is round about the origin: there they
/// leave a gap that closes with the square of the number of points only.
class Polytope {
 public:
  /// A tetrahedron, or nothing where A - B is flat: then its width is asked for, which is the shortest way out.
  explicit Polytope(const Couple& couple);

  /// Takes a way out that is known already.
  void know(double width, const Vec& direction);
  /// Grows until the two bounds are within the tolerance, or for a given number of support points, or until numbers
  /// end.
  void grow(int most_points);
  /// The shortest way out that was met, `width` along `direction`.
  double width() const { return width_; }
  const Vec& direction() const { return direction_; }
  /// No way out is shorter; minus infinity if it does not hold the origin.
  double least() const { return least_; }
  /// Points ended before numbers did.
  bool limit() const { return limit_; }
  /// All that were met.
  const std::vector<std::pair<double, Vec>>& ways() const { return ways_; }

 private:
  struct Face {
    std::array<int, 3> corner;
    std::array<int, 3> beside;  ///< beside[i] shares the edge from corner[i] to the next one
    Vec normal;
    double height;  ///< of its plane over the origin
    bool gone;
  };
  struct Edge {
    int from;
    int to;
    int beyond;  ///< the face that stays
  };

  Face& face(int i) { return faces_[static_cast<std::size_t>(i)]; }
  const Vec& point(int i) const { return points_[static_cast<std::size_t>(i)]; }
  Vec ask(const Vec& unit);
  Vec farther_of_both(const Vec& unit, const Vec& from);
  bool start();
  bool add_face(const std::array<int, 3>& corner, const std::array<int, 3>& beside);
  bool look_from(const Vec& point, int from);
  bool order_horizon();
  bool add(const Vec& point, int above);
  int lowest();

  const Couple& couple_;
  std::vector<std::pair<double, Vec>> ways_;
  std::vector<Vec> points_;
  std::vector<Face> faces_;
  std::vector<std::pair<double, int>>
      by_height_;          ///< a heap, lowest first; faces that are gone stay until they come up
  std::vector<int> seen_;  ///< faces that the point to be added lies beyond
  std::vector<Edge> horizon_;
  double width_ = std::numeric_limits<double>::infinity();
  Vec direction_ = Vec::Zero();
  double least_ = -std::numeric_limits<double>::infinity();
  bool limit_ = false;
  bool stuck_ = true;  ///< numbers ended, or nothing was begun
};

}  // namespace boxstream::ccd
