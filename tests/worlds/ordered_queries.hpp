// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "record/forwarding_broadphase.hpp"

namespace worlds_tests {

/// Reports what rays and sweeps find in the order of unique ids. Bullet's sweeps end where the nearest hit so far is,
/// so that another order can give another last bit.
class OrderedQueries final : public boxstream::record::ForwardingBroadphase {
 public:
  using ForwardingBroadphase::ForwardingBroadphase;

  void rayTest(const btVector3& from, const btVector3& to, btBroadphaseRayCallback& callback, const btVector3& lo,
               const btVector3& hi) override {
    struct Collect final : btBroadphaseRayCallback {
      bool process(const btBroadphaseProxy* proxy) override {
        found.push_back(proxy);
        return true;
      }
      std::vector<const btBroadphaseProxy*> found;
    } collect;
    collect.m_rayDirectionInverse = callback.m_rayDirectionInverse;
    std::copy_n(callback.m_signs, 3, collect.m_signs);
    collect.m_lambda_max = callback.m_lambda_max;
    inner().rayTest(from, to, collect, lo, hi);
    std::sort(collect.found.begin(), collect.found.end(),
              [](const btBroadphaseProxy* a, const btBroadphaseProxy* b) { return a->m_uniqueId < b->m_uniqueId; });
    for (const btBroadphaseProxy* const proxy : collect.found) callback.process(proxy);
  }
};

}  // namespace worlds_tests
