// SPDX-License-Identifier: MIT
#include "papers/volumes/oriented_box.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "papers/volumes/axis_box.hpp"
#include "papers/volumes/splits.hpp"

namespace boxstream::papers::volumes {

namespace {

OrientedBox along(const Eigen::Matrix3d& axes, const Point& origin, Points points) {
  OrientedBox box{origin, axes, Point::Zero()};
  Point low = Point::Zero(), high = Point::Zero();
  for (const Point& p : points) {
    const Point along = axes.transpose() * (p - origin);
    low = low.cwiseMin(along);
    high = high.cwiseMax(along);
  }
  box.centre += axes * ((low + high) / 2);
  // The centre is where rounding has put it; from there, the extents count anew, and are rounded up once.
  double farthest = 0;
  for (const Point& p : points) {
    const Point offset = p - box.centre;
    box.half = box.half.cwiseMax((axes.transpose() * offset).cwiseAbs());
    farthest = std::max(farthest, offset.lpNorm<1>());
  }
  box.half.array() += slack * farthest;
  return box;
}

}  // namespace

OrientedBox OrientedBox::around(Points points) {
  const PrincipalAxes principal = principal_axes(points);
  const OrientedBox turned = along(principal.axes, principal.barycentre, points);
  const OrientedBox plain = along(Eigen::Matrix3d::Identity(), principal.barycentre, points);
  return turned.area() < plain.area() ? turned : plain;
}

OrientedBox OrientedBox::around(Span<const OrientedBox> boxes) {
  std::vector<Point> points;
  for (const OrientedBox& box : boxes)
    for (const Point& corner : box.corners()) points.push_back(corner);
  return around(points);
}

std::array<Point, 8> OrientedBox::corners() const {
  // Corners are rounded, and the axes are not quite at right angles.
  const Point reach = half.array() + slack * (centre.lpNorm<1>() + half.sum());
  std::array<Point, 8> corners;
  for (unsigned i = 0; i < 8; ++i)
    corners[i] =
        centre + axes * Point(i & 1 ? reach[0] : -reach[0], i & 2 ? reach[1] : -reach[1], i & 4 ? reach[2] : -reach[2]);
  return corners;
}

Aabb64 OrientedBox::bounds() const {
  return AxisBox::around(Points(corners())).box;
}

bool overlap(const OrientedBox& a, const OrientedBox& b) {
  const Point way = b.centre - a.centre;
  // In the frame of a. Where two edges are parallel, their cross product is no direction, and the slack keeps it from
  // separating anything.
  const Point t = a.axes.transpose() * way;
  const Eigen::Matrix3d turn = a.axes.transpose() * b.axes;
  const Eigen::Matrix3d reach = turn.cwiseAbs().array() + slack;
  const double error = slack * way.lpNorm<1>();

  for (int i = 0; i < 3; ++i)
    if (std::abs(t[i]) > a.half[i] + reach.row(i).dot(b.half) + slack * a.half.sum() + error) return false;
  for (int j = 0; j < 3; ++j)
    if (std::abs(t.dot(turn.col(j))) > reach.col(j).dot(a.half) + b.half[j] + slack * b.half.sum() + error)
      return false;
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double distance = std::abs(t[i2] * turn(i1, j) - t[i1] * turn(i2, j));
      const double radii = a.half[i1] * reach(i2, j) + a.half[i2] * reach(i1, j) +  //
                           b.half[j1] * reach(i, j2) + b.half[j2] * reach(i, j1);
      if (distance > radii + slack * (a.half.sum() + b.half.sum()) + error) return false;
    }
  }
  return true;
}

}  // namespace boxstream::papers::volumes
