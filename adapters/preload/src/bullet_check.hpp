// SPDX-License-Identifier: MIT
#pragma once

#include <mutex>
#include <unordered_map>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <boxstream/bullet.hpp>

#include "backend.hpp"

namespace boxstream::preload {

/// Runs Bullet's own broad-phase, in the object that the program has, beside the one that serves the program, and
/// compares what the two find. Bullet's grows its boxes and so finds more; of that the pairs whose boxes touch, and
/// that the filter accepts, must be exactly ours.
class BulletCheck {
 public:
  /// `cache` is what Bullet's own keeps its pairs in; it must outlive this. `margin` is that of `ours`.
  BulletCheck(const Front& front, btDbvtBroadphase& own, bullet::Broadphase& ours, btHashedOverlappingPairCache& cache,
              btScalar margin);

  void created(btBroadphaseProxy* proxy, int shape_type);
  void destroyed(btBroadphaseProxy* proxy);
  void moved(btBroadphaseProxy* proxy);
  void batch();
  void ray(const btVector3& from, const btVector3& to, const btBroadphaseRayCallback& callback, const btVector3& min,
           const btVector3& max);
  void box(const btVector3& min, const btVector3& max);

 private:
  using Proxies = std::vector<btBroadphaseProxy*>;

  template <class... Arguments>
  Word call_own(BulletMember member, const Arguments&... arguments);
  Proxies as_ours(const Proxies& own) const;
  void note_difference(const char* text);

  const Front& front_;
  btDbvtBroadphase& own_;
  bullet::Broadphase& ours_;
  btHashedOverlappingPairCache& cache_;
  btVector3 margin_;         // of each side of each box
  btVector3 widest_margin_;  // of those of wide shapes: see bullet::Options::exact_boxes
  std::mutex asking_;        // Bullet's own loses what a ray meets, or reports it twice, where threads ask at once
  std::unordered_map<btBroadphaseProxy*, btBroadphaseProxy*> own_of_;
  std::unordered_map<btBroadphaseProxy*, btBroadphaseProxy*> ours_of_;
};

}  // namespace boxstream::preload
