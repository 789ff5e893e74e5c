// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <btBulletDynamicsCommon.h>

#include "formats/import/fragment.hpp"

/// The parts of the reader of .bullet files.
namespace boxstream::imports {

inline Vec3 vector(const btVector3& v) {
  return {double{v.x()}, double{v.y()}, double{v.z()}};
}
inline Frame frame_of(const btTransform& t) {
  const btQuaternion q = t.getRotation();
  return {vector(t.getOrigin()), {double{q.x()}, double{q.y()}, double{q.z()}, double{q.w()}}};
}

/// What has been left out, how often: one line for each kind.
using LeftOut = std::map<std::string, int>;

/// The convex pieces of a shape. Throws std::runtime_error for kinds that scenes do not have.
std::vector<Piece> convex_pieces(const btCollisionShape& shape);

/// A shape that only static bodies may have; none if it is another kind.
std::optional<Json> fixed_shape(const std::string& path, const btCollisionShape& shape);

/// A body of the file as the fragment has it.
struct KnownBody {
  std::string name;
  bool still = false;
};
using KnownBodies = std::map<const btCollisionObject*, KnownBody>;

/// Adds a constraint, or what becomes of it without some of its properties, or nothing; notes what is missing.
void add_constraint(btTypedConstraint& constraint, bool collide, const KnownBodies& bodies, Fragment& out,
                    LeftOut& left_out);

}  // namespace boxstream::imports
