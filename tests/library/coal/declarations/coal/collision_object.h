// SPDX-License-Identifier: MIT
// Not Coal: see ../README.md.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace coal {

using CoalScalar = double;
using Vec3s = Eigen::Matrix<CoalScalar, 3, 1>;

class AABB {
 public:
  Vec3s min_, max_;
};

class CollisionGeometry {
 public:
  virtual ~CollisionGeometry() = default;
};

class CollisionObject {
 public:
  explicit CollisionObject(const std::shared_ptr<CollisionGeometry>& geometry, bool = true) : geometry_(geometry) {}
  const AABB& getAABB() const { return aabb_; }
  AABB& getAABB() { return aabb_; }

 private:
  std::shared_ptr<CollisionGeometry> geometry_;
  AABB aabb_;
};

}  // namespace coal
