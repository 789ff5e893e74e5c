// SPDX-License-Identifier: MIT
// CollisionManager, compiled once for all files that use it.
#include <boxstream/fcl.hpp>

namespace boxstream::fcl {

template class CollisionManager<float>;
template class CollisionManager<double>;

}  // namespace boxstream::fcl
