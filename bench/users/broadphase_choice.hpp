// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <boxstream/bullet.hpp>

class btBroadphaseInterface;
class btOverlappingPairCache;

namespace boxstream::bench {

/// What a program sets when it makes its broad-phase.
struct BroadphaseChoice {
  std::string name;                             ///< boxstream, dbvt, dbvt-deferred, sap16 or sap
  btOverlappingPairCache* cache = nullptr;      ///< borrowed; null: the broad-phase's own
  bullet::Eager eager = bullet::Eager::ghosts;  ///< of boxstream
};

/// Sweep and prune is built for `most` objects within `reach` of the origin.
std::unique_ptr<btBroadphaseInterface> make_broadphase(const BroadphaseChoice& choice, double reach, std::size_t most);

/// Whether the broad-phase can hold that number of objects.
bool can_hold(const std::string& name, std::size_t objects);

}  // namespace boxstream::bench
