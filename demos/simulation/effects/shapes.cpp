// SPDX-License-Identifier: MIT
#include "simulation/effects/activity.hpp"
#include "simulation/effects/effects.hpp"
#include "simulation/effects/find.hpp"

// Shapes that are more than a convex solid.
namespace boxstream::effects {
namespace {

template <class Shape>
std::optional<Call> a_body_has(const Subject& subject) {
  return first_shape<Shape>(subject, "a body of this shape");
}

}  // namespace

const Effect planes{"planes",
                    "endless ground",
                    "btStaticPlaneShape, and pairs with everything, when a body has it",
                    a_body_has<scenes::PlaneShape>,
                    {},
                    {"contact points", count_points_of_shape<scenes::PlaneShape>}};

const Effect meshes{"meshes",
                    "ground made of triangles",
                    "btBvhTriangleMeshShape and its tree, when a body has it",
                    a_body_has<scenes::MeshShape>,
                    {},
                    {"contact points", count_points_of_shape<scenes::MeshShape>}};

const Effect heightfields{"heightfields",
                          "ground made of heights",
                          "btHeightfieldTerrainShape, when a body has it",
                          a_body_has<scenes::HeightfieldShape>,
                          {},
                          {"contact points", count_points_of_shape<scenes::HeightfieldShape>}};

const Effect compounds{"compounds",
                       "bodies made of several shapes",
                       "btCompoundShape and its tree, when a body has it",
                       a_body_has<scenes::CompoundShape>,
                       {},
                       {"contact points", count_points_of_shape<scenes::CompoundShape>}};

}  // namespace boxstream::effects
