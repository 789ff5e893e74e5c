// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btOverlappingPairCache.h>

#include <boxstream/bullet/precision.hpp>
#include <boxstream/world.hpp>

#include "proxy.hpp"

namespace boxstream::bullet {
inline namespace BOXSTREAM_BULLET_PRECISION {

/// Pairs added to the own cache or removed from it without the World: by users, or with a proxy. They are released in
/// the World before the next update, which decides about them anew.
class UserChanges {
 public:
  void add(const btBroadphasePair& pair) {
    // Adding and removing without a batch must not grow the list without bound.
    if (pending_.size() == pending_.capacity()) keep_one_each();
    pending_.emplace_back(static_cast<const Proxy&>(*pair.m_pProxy0).id, static_cast<const Proxy&>(*pair.m_pProxy1).id);
  }

  /// Calls `release(a, b)` for each pair since the last call. Ids may be stale or null.
  template <class Release>
  void flush(Release&& release) {
    for (const auto& [a, b] : pending_) release(a, b);
    pending_.clear();
  }

  bool empty() const { return pending_.empty(); }

  bool contains(ProxyId a, ProxyId b) const {
    return std::any_of(pending_.begin(), pending_.end(),
                       [&](const Ids& ids) { return ids == Ids(a, b) || ids == Ids(b, a); });
  }

 private:
  using Ids = std::pair<ProxyId, ProxyId>;

  void keep_one_each() {
    const auto numbers = [](const Ids& ids) {
      return std::tuple(ids.first.slot, ids.first.generation, ids.second.slot, ids.second.generation);
    };
    std::sort(pending_.begin(), pending_.end(), [&](const Ids& x, const Ids& y) { return numbers(x) < numbers(y); });
    pending_.erase(std::unique(pending_.begin(), pending_.end()), pending_.end());
    pending_.reserve(2 * pending_.size());  // so that it is not done again soon
  }

  std::vector<Ids> pending_;
};

}  // namespace BOXSTREAM_BULLET_PRECISION
}  // namespace boxstream::bullet
