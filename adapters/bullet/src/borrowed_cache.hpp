// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/world.hpp>

#include "cache_snapshot.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// False for btNullPairCache, and for nothing else: every other class may keep pairs. The cache is not touched.
/// The test does without RTTI, which Bullet is often built without. If a program has several copies of the class, in
/// shared libraries, one may be taken for another class: then pairs are computed for it, and it ignores them.
bool keeps_pairs(const btOverlappingPairCache& cache);

/// For caches whose removal is deferred to the broad-phase, as btSortedOverlappingPairCache's is: sorts their array,
/// frees the algorithms of pairs whose boxes no longer overlap in `world`, and drops these and repeated entries.
void remove_deferred(btOverlappingPairCache& cache, const BasicWorld<btScalar>& world, btDispatcher* dispatcher);

/// Finds pairs that users have added to the cache or removed from it. Releases them in `world`, so that they begin
/// again if they should, and removes pairs whose boxes do not overlap from the cache.
void reconcile(btOverlappingPairCache& cache, CacheSnapshot& snapshot, BasicWorld<btScalar>& world,
               btDispatcher* dispatcher);

/// Aborts before `more` pairs would overflow Bullet's arrays.
void require_room(const btOverlappingPairCache& cache, std::size_t more);

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
