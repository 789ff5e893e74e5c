// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/geometry/collision_geometry.h>

#include <memory>

#include "references/closed_forms.hpp"

/// Of FCL in double.
namespace boxstream::report::narrow {

using FclShape = std::shared_ptr<::fcl::CollisionGeometry<double>>;

/// A box, a sphere or a capsule, as FCL has them.
FclShape exact_shape(const RoundedBox& solid);

struct FclMeshing {
  int triangles = 0;     ///< at least; of a whole sphere
  bool as_hull = false;  ///< one convex shape, not triangles
  bool halfway = false;  ///< points as far outside of the true surface as faces are inside, where they are inside most
};

/// Round shapes as triangles, boxes as they are. Those that are alike share one mesh. Throws std::invalid_argument for
/// a capsule as hull.
FclShape mesh_shape(const RoundedBox& solid, const FclMeshing& meshing);

}  // namespace boxstream::report::narrow
