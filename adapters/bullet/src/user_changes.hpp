// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/world.hpp>

#include "precision.hpp"
#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Which pairs came to the own cache, or left it, without the World: by users, or with a proxy. The World is told to
/// forget them before it begins or ends any, so that it decides about them anew. Nothing is looked up when they come.
class UserChanges {
 public:
  void add(const btBroadphasePair& pair) {
    // Adding and removing, over and over without a batch, must not take ever more memory.
    if (untold_.size() == untold_.capacity()) keep_one_each();
    untold_.emplace_back(static_cast<const Proxy&>(*pair.m_pProxy0).id, static_cast<const Proxy&>(*pair.m_pProxy1).id);
  }

  /// Calls `forget(a, b)` for each since the last call. Ids may be stale or null.
  template <class Forget>
  void tell(Forget&& forget) {
    for (const auto& [a, b] : untold_) forget(a, b);
    untold_.clear();
  }

  bool contains(ProxyId a, ProxyId b) const {
    return std::any_of(untold_.begin(), untold_.end(),
                       [&](const Ids& ids) { return ids == Ids(a, b) || ids == Ids(b, a); });
  }

 private:
  using Ids = std::pair<ProxyId, ProxyId>;

  void keep_one_each() {
    const auto numbers = [](const Ids& ids) {
      return std::tuple(ids.first.slot, ids.first.generation, ids.second.slot, ids.second.generation);
    };
    std::sort(untold_.begin(), untold_.end(), [&](const Ids& x, const Ids& y) { return numbers(x) < numbers(y); });
    untold_.erase(std::unique(untold_.begin(), untold_.end()), untold_.end());
  }

  std::vector<Ids> untold_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
