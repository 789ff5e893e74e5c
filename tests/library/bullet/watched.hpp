// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>
#include <boxstream/aabb.hpp>

#include <vector>

#include "core/oracle.hpp"
#include "oracle.hpp"
#include "support.hpp"

namespace boxstream::bullet_test {

inline Box to_box(const boxstream::BasicAabb<btScalar>& box) {
  return {btVector3(box.min[0], box.min[1], box.min[2]), btVector3(box.max[0], box.max[1], box.max[2])};
}

/// A rig with an oracle. After each batch pairs are those of brute force, and every invariant holds.
struct Watched {
  explicit Watched(btOverlappingPairCache* cache = nullptr)
      : oracle(new Oracle(make_broadphase(Kind::subject, cache))) {
    rig.broadphase.reset(oracle);
  }
  std::vector<btBroadphaseProxy*> create(const boxstream::tests::Boxes<btScalar>& boxes) {
    std::vector<btBroadphaseProxy*> proxies;
    for (const auto& box : boxes) proxies.push_back(rig.create(to_box(box)));
    return proxies;
  }
  testing::AssertionResult calculate() {
    rig.calculate();
    validate(oracle->inner());
    return oracle->check(Rule::exact);
  }

  Rig rig;
  Oracle* oracle;
};

}  // namespace boxstream::bullet_test
