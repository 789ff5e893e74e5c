// SPDX-License-Identifier: MIT
#include "abi_check.hpp"

#include <cstddef>
#include <cstring>

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

#include "fatal.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

namespace {

/// Where a leaf of btDbvt has its data: behind a box, which is eight scalars, and a pointer.
template <class Scalar>
constexpr std::size_t data_offset = 8 * sizeof(Scalar) + sizeof(void*);

}  // namespace

bool libraries_have_our_precision() {
  static_assert(offsetof(btDbvtNode, data) == data_offset<btScalar>);
  // Room for what libraries of either precision read and write. A tree takes the node that was freed last, if any, so
  // nothing is allocated.
  alignas(64) unsigned char box[8 * sizeof(double)] = {};
  alignas(64) unsigned char node[8 * sizeof(double) + 4 * sizeof(void*)] = {};
  btDbvt tree;
  tree.m_free = reinterpret_cast<btDbvtNode*>(node);
  char cookie = 0;
  tree.insert(*reinterpret_cast<const btDbvtVolume*>(box), &cookie);
  tree.m_root = nullptr;
  const void* data_if_float = nullptr;  // in double precision it is a part of the box
  std::memcpy(&data_if_float, node + data_offset<float>, sizeof(data_if_float));
  return (data_if_float == &cookie) == (sizeof(btScalar) == sizeof(float));
}

void require_matching_precision() {
  if (libraries_have_our_precision()) return;
  fatal(sizeof(btScalar) == sizeof(float)
            ? "built for single precision, but linked with Bullet libraries in double precision: use "
              "boxstream::bullet_float64 and compile with BT_USE_DOUBLE_PRECISION, or link the single precision "
              "libraries"
            : "built for double precision, but linked with Bullet libraries in single precision: use "
              "boxstream::bullet and compile without BT_USE_DOUBLE_PRECISION, or link the double precision libraries");
}

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
