// SPDX-License-Identifier: MIT
#pragma once

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

namespace boxstream::scenes {

/// For btOverlappingPairCache::processAllOverlappingPairs: ends every pair, algorithms and ghosts' lists included.
struct EndAllPairs final : btOverlapCallback {
  bool processOverlap(btBroadphasePair&) override { return true; }
};

}  // namespace boxstream::scenes
