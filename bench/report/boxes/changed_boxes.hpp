// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <unordered_map>
#include <vector>

#include <boxstream/aabb.hpp>
#include <boxstream/pair.hpp>

#include "formats/record/forwarding_broadphase.hpp"

class btCollisionObject;

namespace boxstream::report {

/// Makes the box that a broad-phase gets of the one that Bullet gives it.
using ChangeOfBox = std::function<Aabb(const Aabb& given, const btCollisionObject& object)>;

/// Bullet's box without the distance at which contacts begin, which it adds on all sides.
Aabb tight_box(const Aabb& given);

/// A box around the bounding sphere of the shape, wherever it turns, and the same distance; it contains the one given,
/// which also reaches to where the body is about to be.
Aabb sphere_box(const Aabb& given, const btCollisionObject& object);

/// A broad-phase that gets other boxes than Bullet gave, and remembers those. For worlds whose clients are collision
/// objects, all of them; distinguished by their user index.
class ChangedBoxes final : public record::ForwardingBroadphase {
 public:
  ChangedBoxes(std::unique_ptr<btBroadphaseInterface> inner, ChangeOfBox change);

  btBroadphaseProxy* createProxy(const btVector3& lo, const btVector3& hi, int shape_type, void* client, int group,
                                 int mask, btDispatcher* dispatcher) override;
  void destroyProxy(btBroadphaseProxy* proxy, btDispatcher* dispatcher) override;
  void setAabb(btBroadphaseProxy* proxy, const btVector3& lo, const btVector3& hi, btDispatcher* dispatcher) override;

  /// Pairs whose tight boxes overlap and whose filters accept, as user indices, sorted: those that no kind of box may
  /// miss. All against all.
  std::vector<Pair> needed_pairs() const;

 private:
  ChangeOfBox change_;
  std::unordered_map<const btBroadphaseProxy*, Aabb> given_;
};

}  // namespace boxstream::report
