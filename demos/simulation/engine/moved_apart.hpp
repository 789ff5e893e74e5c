// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>

namespace boxstream::scenes {

/// How deep in metres two bodies of these least extents may be in each other before velocities that push them apart are
/// large beside the speeds with which bodies of their size move. An extent of 0 does not count: it has none.
double deep_from(double thickness, double other);

/// Which contacts a solver moves apart by split impulses, which give bodies no speed. The others are pushed apart by
/// velocities, with which stacks stand better: those are warm-started, and turn bodies as well.
class MovedApart {
 public:
  /// Depths of contacts are compared with the extents of what touches.
  struct Bodies {
    std::vector<double> thickness;  ///< least extent in metres of each object, by `getUserIndex()`; 0 where it has none
    bool have_weight = true;        ///< something makes them rest on each other
  };

  MovedApart() = default;
  explicit MovedApart(Bodies bodies) : bodies_(std::move(bodies)) {}

  /// The distance in metres, zero or negative, below which contacts of a manifold are to be moved apart. Keeps in the
  /// manifold how deep it was.
  btScalar threshold(btPersistentManifold& manifold) const;

  /// The depth in metres beyond which contacts that velocities push apart are pushed no faster.
  btScalar deepest_push(const btPersistentManifold& manifold) const;

 private:
  double bound(const btPersistentManifold& manifold) const;
  double thickness_of(const btCollisionObject& object) const;

  Bodies bodies_;
};

}  // namespace boxstream::scenes
