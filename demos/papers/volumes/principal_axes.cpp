// SPDX-License-Identifier: MIT
#include "papers/volumes/principal_axes.hpp"

#include <Eigen/Eigenvalues>

namespace boxstream::papers::volumes {

PrincipalAxes principal_axes(Points points) {
  Point sum = Point::Zero();
  for (const Point& p : points) sum += p;
  const Point barycentre = sum / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const Point& p : points) covariance += (p - barycentre) * (p - barycentre).transpose();
  return {barycentre, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors()};
}

}  // namespace boxstream::papers::volumes
