// SPDX-License-Identifier: MIT
#pragma once

#include <fcl/narrowphase/collision.h>

#include <utility>

#include "peers/fcl_peer.hpp"

namespace boxstream::report {

/// Orders two objects by their indices: the order changes the last digits of FCL's results.
inline void order_by_index(const ::fcl::CollisionObject<double>*& a, const ::fcl::CollisionObject<double>*& b) {
  if (bench::fcl_index<double>(b) < bench::fcl_index<double>(a)) std::swap(a, b);
}

/// By FCL's narrow phase.
inline bool fcl_touch(const ::fcl::CollisionObject<double>* a, const ::fcl::CollisionObject<double>* b) {
  order_by_index(a, b);
  ::fcl::CollisionResult<double> result;
  return ::fcl::collide(a, b, ::fcl::CollisionRequest<double>(), result) > 0;
}

}  // namespace boxstream::report
